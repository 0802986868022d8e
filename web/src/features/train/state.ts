// What the view keeps while another view is open: the form, the selection, the layers.

import { createSignal, type Accessor, type Setter } from 'solid-js';
import type { Vec2 } from '../../lab/geometry';
import type { Layers } from './drawFrame';
import { BLANK, type Draft } from './recipes';

export interface TrainState {
  readonly draft: Accessor<Draft>;
  readonly setDraft: Setter<Draft>;
  /** Id of the shown training; undefined: the newest. */
  readonly chosen: Accessor<string | undefined>;
  readonly choose: Setter<string | undefined>;
  /** Id of the training beside it. */
  readonly compared: Accessor<string | undefined>;
  readonly compare: Setter<string | undefined>;
  readonly layers: Accessor<Layers>;
  readonly setLayers: Setter<Layers>;
  /** The place whose cell is shown, in both trainings. */
  readonly place_m: Accessor<Vec2 | undefined>;
  readonly setPlace: Setter<Vec2 | undefined>;
  /** Fills in the map of the session, and a name for its policy. */
  showMap(): void;
}

export function createTrainState(): TrainState {
  const [draft, setDraft] = createSignal<Draft>(BLANK);
  const [chosen, choose] = createSignal<string>();
  const [compared, compare] = createSignal<string>();
  const [layers, setLayers] = createSignal<Layers>({
    values: true,
    arrows: true,
    starts: true,
    episodes: true,
  });
  const [place_m, setPlace] = createSignal<Vec2>();
  return {
    ...{ draft, setDraft, chosen, choose, compared, compare },
    ...{ layers, setLayers, place_m, setPlace },
    showMap: () => {
      const { startFrom, recipe, settings, seed } = draft();
      setDraft({ startFrom, recipe, settings, seed });
    },
  };
}

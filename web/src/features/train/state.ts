// What the view keeps while another view is open: the form, the selection, the layers.

import { createSignal } from 'solid-js';
import type { Vec2 } from '../../lab/geometry';
import { createDraft } from '../../ui/fields/draft';
import type { Layers } from './drawFrame';
import { BLANK } from './recipes';

export const { draft, change, edits } = createDraft(BLANK);

/** Id of the shown training; undefined: the newest. */
export const [chosen, choose] = createSignal<string>();

/** Id of the training beside it. */
export const [compared, compare] = createSignal<string>();

export const [layers, setLayers] = createSignal<Layers>({
  values: true,
  arrows: true,
  starts: true,
  episodes: true,
});

/** The place whose cell is shown, in both trainings. */
export const [place_m, setPlace] = createSignal<Vec2>();

/** Whether the form for a new training is open although there are trainings. */
export const [isNew, setNew] = createSignal(false);

export const [hasCurves, setCurves] = createSignal(false);

/** Whether the shipped finished training plays before the first one of one's own. */
export const [playsFinished, setPlaysFinished] = createSignal(false);

/** Opens the form with the map of the session, and a name for its policy. */
export function showMap(): void {
  change({ map: undefined, name: undefined });
  setNew(true);
}

// Which layers of the map are shown, as the user chose.

import { createSignal, type Accessor } from 'solid-js';
import { recall, remember } from '../ui/storage';

const KEY = 'layers';

export interface KnownLayer {
  readonly id: string;
  readonly shownAtFirst?: true;
}

/** The stored choice, without layers that no longer exist; the default when there is no stored choice. */
export function layersFrom(text: string | null, known: readonly KnownLayer[]): ReadonlySet<string> {
  let chosen: unknown;
  try {
    chosen = JSON.parse(text ?? 'null');
  } catch {
    // Written by something else.
  }
  const isChosen = Array.isArray(chosen)
    ? ({ id }: KnownLayer) => (chosen as unknown[]).includes(id)
    : ({ shownAtFirst }: KnownLayer) => shownAtFirst === true;
  return new Set(known.filter(isChosen).map(({ id }) => id));
}

export interface Layers {
  readonly layers: Accessor<ReadonlySet<string>>;
  showLayer(id: string, on: boolean): void;
}

export function createLayerChoice(known: readonly KnownLayer[]): Layers {
  const [layers, setLayers] = createSignal(layersFrom(recall(KEY), known));
  return {
    layers,
    showLayer: (id, on) => {
      const next = new Set(layers());
      if (on) next.add(id);
      else next.delete(id);
      setLayers(next);
      remember(KEY, JSON.stringify([...next]));
    },
  };
}

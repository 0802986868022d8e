// Which layers of the map are shown, as the user chose.

import { createMemo, createSignal, type Accessor } from 'solid-js';
import { recall, remember } from '../ui/storage';

const KEY = 'layers';

export interface KnownLayer {
  readonly id: string;
  readonly shownAtFirst?: true;
}

/** The layers that the user has switched, as stored: `{"flow":true}`. A layer that is not among them, as one that is new to
 * this browser, is shown by its default. */
export function switchedFrom(text: string | null): Readonly<Record<string, unknown>> {
  try {
    const stored: unknown = JSON.parse(text ?? '{}');
    const isRecord = typeof stored === 'object' && stored !== null && !Array.isArray(stored);
    return isRecord ? { ...stored } : {};
  } catch {
    // Written by something else.
    return {};
  }
}

export function shownLayers(
  known: readonly KnownLayer[],
  switched: Readonly<Record<string, unknown>>,
): ReadonlySet<string> {
  const isShown = ({ id, shownAtFirst }: KnownLayer): boolean => {
    const choice = switched[id];
    return typeof choice === 'boolean' ? choice : shownAtFirst === true;
  };
  return new Set(known.filter(isShown).map(({ id }) => id));
}

export interface Layers {
  readonly layers: Accessor<ReadonlySet<string>>;
  showLayer(id: string, on: boolean): void;
}

export function createLayerChoice(known: readonly KnownLayer[]): Layers {
  const [switched, setSwitched] = createSignal(switchedFrom(recall(KEY)));
  const layers = createMemo(() => shownLayers(known, switched()));
  return {
    layers,
    showLayer: (id, on) => {
      const isDefault = on === (known.find((layer) => layer.id === id)?.shownAtFirst ?? false);
      const others = Object.entries(switched()).filter(([other]) => other !== id);
      const next = Object.fromEntries(isDefault ? others : [...others, [id, on]]);
      setSwitched(next);
      remember(KEY, JSON.stringify(next));
    },
  };
}

// Which layers of the map are shown, as the user chose.

import { createMemo } from 'solid-js';
import { createChoice } from '../ui/storage';

export interface KnownLayer {
  readonly id: string;
  readonly shownAtFirst?: true;
}

export type Layers = ReturnType<typeof createLayerChoice>;

export function createLayerChoice(known: readonly KnownLayer[]) {
  const choices = known.map(({ id, shownAtFirst }) => {
    const key = `layer.${id}`;
    const [choice, choose] = shownAtFirst
      ? createChoice(key, ['shown', 'hidden'])
      : createChoice(key, ['hidden', 'shown']);
    return { id, choice, choose };
  });
  return {
    layers: createMemo<ReadonlySet<string>>(
      () => new Set(choices.filter(({ choice }) => choice() === 'shown').map(({ id }) => id)),
    ),
    showLayer: (id: string, on: boolean) =>
      choices.find((one) => one.id === id)?.choose(on ? 'shown' : 'hidden'),
  };
}

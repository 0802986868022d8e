// Reads the gamepads while the hand steers. The browser has no events for sticks.

import { createEffect, createSignal, onCleanup, type Accessor } from 'solid-js';
import type { Vec2 } from '../../lab/geometry';
import type { ByHand } from '../../lab/slices';
import { chosenPad, readPad } from './gamepad';
import { type Direction, learned, readBy, UNKNOWN, wanted } from './layout';

export interface Follower {
  /** The gamepad that steers, if there is one, and what the user has to push before it does. */
  readonly pad: Accessor<{ id: string; isKnown: boolean; asks: Direction | undefined } | undefined>;
  /** Forgets what the user has pushed. */
  readonly relearn: () => void;
}

/** Pads without a layout, as long as the page is open. */
const layouts = new Map<string, typeof UNKNOWN>();
const nameOf = ({ index, id }: Gamepad): string => `${index} ${id}`;
const isKnown = ({ mapping }: Gamepad): boolean => mapping === 'standard';
const layoutOf = (pad: Gamepad): typeof UNKNOWN => layouts.get(nameOf(pad)) ?? UNKNOWN;
const read = (pad: Gamepad): Vec2 | 'hold' =>
  isKnown(pad) ? readPad(pad) : readBy(layoutOf(pad), pad);

/** Follows the gamepads while the hand steers. */
export function followGamepads({ steering }: Pick<ByHand, 'steering'>): Follower {
  const [pad, setPad] = createSignal<ReturnType<Follower['pad']>>(undefined, {
    equals: (a, b) => a?.id === b?.id && a?.isKnown === b?.isKnown && a?.asks === b?.asks,
  });
  createEffect(() => {
    if (!steering.isActive()) return;
    let request = 0;
    let wasHeld = false;
    const look = (): void => {
      request = requestAnimationFrame(look);
      const pads = navigator.getGamepads();
      for (const one of pads)
        if (one && !isKnown(one))
          layouts.set(nameOf(one), learned(layoutOf(one), one, performance.now()));
      const chosen = chosenPad(pads, read);
      setPad(
        chosen && {
          id: chosen.id,
          isKnown: isKnown(chosen),
          asks: isKnown(chosen) ? undefined : wanted(layoutOf(chosen)),
        },
      );
      if (!chosen) return;
      const now = read(chosen);
      if (now !== 'hold') steering.lean('gamepad', now);
      else if (!wasHeld) steering.hold();
      wasHeld = now === 'hold';
    };
    look();
    onCleanup(() => {
      cancelAnimationFrame(request);
      steering.lean('gamepad', [0, 0]);
    });
  });
  return { pad, relearn: () => layouts.clear() };
}

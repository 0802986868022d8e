// Reads the gamepads while the hand steers. The browser has no events for sticks.

import { createEffect, createSignal, onCleanup, type Accessor } from 'solid-js';
import type { ByHand } from '../../lab/slices';
import { chosenPad, readPad } from './gamepad';

/** Follows the gamepads while the returned name is read; the name of the one that steers, if there is one. */
export function followGamepads({
  steering,
}: Pick<ByHand, 'steering'>): Accessor<string | undefined> {
  const [name, setName] = createSignal<string>();
  createEffect(() => {
    if (!steering.isActive()) return;
    let request = 0;
    let wasHeld = false;
    const read = (): void => {
      request = requestAnimationFrame(read);
      const pad = chosenPad(navigator.getGamepads());
      setName(pad?.id);
      if (!pad) return;
      const now = readPad(pad);
      if (now !== 'hold') steering.lean('gamepad', now);
      else if (!wasHeld) steering.hold();
      wasHeld = now === 'hold';
    };
    read();
    onCleanup(() => {
      cancelAnimationFrame(request);
      steering.lean('gamepad', [0, 0]);
    });
  });
  return name;
}

// The sticks and buttons of a gamepad as a direction. Pure.

import type { Vec2 } from '../../lab/geometry';

/** Sticks rest a little beside their middle. */
export const DEAD_ZONE = 0.2;
/** Of the standard layout (W3C Gamepad, §11). */
const BUTTONS = { hold: 0, up: 12, down: 13, left: 14, right: 15 } as const;

export interface Pad {
  readonly axes: readonly number[];
  readonly buttons: readonly { readonly pressed: boolean }[];
}

/** A stick without its dead zone, with a length of at most 1; up is positive. */
export function stick(x: number, y: number): Vec2 {
  const length = Math.hypot(x, y);
  if (!(length > DEAD_ZONE)) return [0, 0];
  const scale = Math.min(1, (length - DEAD_ZONE) / (1 - DEAD_ZONE)) / length;
  return [x * scale, -y * scale];
}

/**
 * The direction of a gamepad with the standard layout: its cross, otherwise its left stick, otherwise its right one; `hold`
 * while its first button is pressed.
 */
export function readPad({ axes, buttons }: Pad): Vec2 | 'hold' {
  const isPressed = (name: keyof typeof BUTTONS): number =>
    buttons[BUTTONS[name]]?.pressed ? 1 : 0;
  if (isPressed('hold')) return 'hold';
  const cross: Vec2 = [isPressed('right') - isPressed('left'), isPressed('up') - isPressed('down')];
  if (cross[0] !== 0 || cross[1] !== 0) return cross;
  const left = stick(axes[0] ?? 0, axes[1] ?? 0);
  return left[0] !== 0 || left[1] !== 0 ? left : stick(axes[2] ?? 0, axes[3] ?? 0);
}

/** The first gamepad that does something by `read`, otherwise the first one. */
export function chosenPad<P>(
  pads: readonly (P | null)[],
  read: (pad: P) => Vec2 | 'hold',
): P | undefined {
  const there = pads.filter((pad) => pad !== null);
  const isUsed = (pad: P): boolean => {
    const now = read(pad);
    return now === 'hold' || now[0] !== 0 || now[1] !== 0;
  };
  return there.find(isUsed) ?? there[0];
}

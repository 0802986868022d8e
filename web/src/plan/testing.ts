// Gestures for tests.

import type { Vec2 } from '../lab/geometry';
import { type Effect, type GestureEvent, type Mode, REST, step } from './gesture';
import type { End } from './release';

export function play(events: readonly GestureEvent[], from: Mode = REST) {
  let mode = from;
  const effects: Effect[] = [];
  for (const event of events) {
    const next = step(mode, event);
    mode = next.mode;
    effects.push(...next.effects);
  }
  return { mode, effects, types: effects.map(({ type }) => type) };
}

/** In these tests a pixel is a metre. */
export const down = (
  at: Vec2,
  given: Partial<GestureEvent & { type: 'down' }> = {},
): GestureEvent => ({
  type: 'down',
  pointer: 1,
  px: at,
  at,
  slop_px: 3,
  grip: 'turn',
  isMain: true,
  onBead: false,
  mayAct: true,
  steers: false,
  ...given,
});
export const move = (px: Vec2, pointer = 1, lift = false): GestureEvent => ({
  type: 'move',
  pointer,
  px,
  at: px,
  lift,
});
export const up = (pointer = 1): GestureEvent => ({ type: 'up', pointer });
export const end = (cause: End, pointer?: number): GestureEvent => ({
  type: 'end',
  cause,
  ...(pointer !== undefined && { pointer }),
});
export const onBead = { onBead: true };
export const steers = { steers: true };
export const beside = (pointer = 1): GestureEvent =>
  ({ ...move([90, 9], pointer), at: undefined }) as GestureEvent;

export const PRESSED = play([down([10, 10], onBead)]).mode;
export const DRAGGED = play([down([10, 10], onBead), move([20, 10])]).mode;
export const BY_KEYBOARD = play([{ type: 'take', at: [10, 10] }]).mode;
export const STEERED = play([down([10, 10], steers)]).mode;

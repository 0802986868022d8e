// What the operator can do to the bead besides pulling it by hand. Pure.

import type { Disturbance } from './protocol.gen';

export const DIRECTIONS = [
  ['random', 'random'],
  ['right', '→ right'],
  ['up', '↑ up'],
  ['left', '← left'],
  ['down', '↓ down'],
] as const;
export type Direction = (typeof DIRECTIONS)[number][0];

/** As drawn: x to the right, y up. */
const UNIT: Readonly<Record<Exclude<Direction, 'random'>, readonly [number, number]>> = {
  right: [1, 0],
  up: [0, 1],
  left: [-1, 0],
  down: [0, -1],
};

/** `chance` in [0, 1) chooses a random direction. */
export function unitVector(direction: Direction, chance: number): readonly [number, number] {
  if (direction !== 'random') return UNIT[direction];
  const angle = 2 * Math.PI * chance;
  return [Math.cos(angle), Math.sin(angle)];
}

export function kick(strength_mn_s: number, [x, y]: readonly [number, number]): Disturbance {
  const strength_n_s = strength_mn_s / 1000;
  return { impulse: { x_n_s: x * strength_n_s, y_n_s: y * strength_n_s } };
}

export function push(
  force_mn: number,
  for_s: number,
  [x, y]: readonly [number, number],
): Disturbance {
  const force_n = force_mn / 1000;
  return { drift: { x_n: x * force_n, y_n: y * force_n, for_s } };
}

export function blind(for_s: number): Disturbance {
  return { dropout: { for_s } };
}

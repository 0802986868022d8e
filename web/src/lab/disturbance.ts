// The operator's disturbances besides dragging the bead: now or by script. Pure.

import { clock, fixed } from '../ui/format';
import { place } from '../words/facts';
import { type Experiment, experimentOf, loadMessage } from './experimentLink';
import type {
  ClientMessage,
  Disturbance,
  SceneMessage,
  StateMessage,
  When,
} from '../net/protocol.gen';

/** A larger number would leave no time for anything else. */
export const MAX_RANDOM = 20;

export const DIRECTIONS = [
  ['random', 'random'],
  ['right', '→ right'],
  ['up', '↑ up'],
  ['left', '← left'],
  ['down', '↓ down'],
] as const;
export type Direction = (typeof DIRECTIONS)[number][0];

export const KINDS = [
  ['kick', 'Kick'],
  ['push', 'Push'],
  ['move', 'Move'],
  ['blind', 'Blind tracker'],
] as const;
export type Kind = (typeof KINDS)[number][0];

export const TIMES = [
  ['now', 'now'],
  ['time', 'at a time'],
  ['step', 'at a step'],
  ['passes', 'passing x'],
  ['near', 'near a place'],
] as const;
export type Time = (typeof TIMES)[number][0];

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

export const move = (x_m: number, y_m: number): Disturbance => ({ displace: { x_m, y_m } });

export const blind = (for_s: number): Disturbance => ({ dropout: { for_s } });

const ARROWS = ['→', '↗', '↑', '↖', '←', '↙', '↓', '↘'];

/** The nearest of eight arrows. */
function arrow(x: number, y: number): string {
  const eighth = Math.round((4 * Math.atan2(y, x)) / Math.PI);
  return ARROWS[(eighth + 8) % 8] ?? '';
}

export function describe(disturbance: Disturbance): string {
  if ('displace' in disturbance) {
    return `move to ${place(disturbance.displace.x_m, disturbance.displace.y_m)}`;
  }
  if ('impulse' in disturbance) {
    const { x_n_s, y_n_s } = disturbance.impulse;
    return `kick ${arrow(x_n_s, y_n_s)} ${fixed(1000 * Math.hypot(x_n_s, y_n_s), 2)} mN·s`;
  }
  if ('drift' in disturbance) {
    const { x_n, y_n, for_s } = disturbance.drift;
    return `push ${arrow(x_n, y_n)} ${fixed(1000 * Math.hypot(x_n, y_n), 1)} mN for ${for_s} s`;
  }
  return `tracker blind for ${disturbance.dropout.for_s} s`;
}

export function describeWhen(at: When, tick_s: number): string {
  if ('tick' in at) return `at ${clock(at.tick * tick_s)}`;
  if ('step' in at) return `at step ${at.step}`;
  if ('passes_x_m' in at) return `passing x = ${fixed(at.passes_x_m, 3)} m`;
  const { x_m, y_m, within_m } = at.near;
  return `within ${fixed(100 * within_m, 1)} cm of ${place(x_m, y_m)}`;
}

/** The trial from its start with other disturbances. Everything else stays as it is now. */
export function restart(
  scene: SceneMessage,
  state: StateMessage,
  change: Partial<Pick<Experiment, 'script' | 'disturbances'>>,
): ClientMessage {
  const place = state.goal_m ?? scene.scenario.goal_m;
  // Exactly where it is; a link rounds it.
  const goal_m: Experiment['goal_m'] = place && [place[0], place[1]];
  const now = experimentOf(scene, { controller: state.controller, goal_m });
  return loadMessage({ ...now, goal_m, ...change }, scene.defaults);
}

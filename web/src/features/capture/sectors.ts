// Where the pull of the magnet is stronger than friction: a ring of sectors, because a turned block pulls differently in
// each direction.

import type { Vec2 } from '../../lab/geometry';
import type { SceneMessage } from '../../net/protocol.gen';

/** Used for a reach without an end: larger than any workspace. */
const BEYOND_M = 3;

/** The inner and the outer edge of a part of the ring around the tool. */
export interface Sector {
  readonly inner: readonly [Vec2, Vec2];
  readonly outer: readonly [Vec2, Vec2];
}

export function sectorsOf({ capture_m }: Pick<SceneMessage, 'capture_m'>): Sector[] {
  const angle = (2 * Math.PI) / capture_m.length;
  const at = (k: number, distance_m: number): Vec2 => [
    distance_m * Math.cos(k * angle),
    distance_m * Math.sin(k * angle),
  ];
  return capture_m.flatMap((reach, k) => {
    const next = capture_m[(k + 1) % capture_m.length];
    if (!reach || !next) return [];
    return {
      inner: [at(k, reach[0]), at(k + 1, next[0])],
      outer: [at(k, reach[1] ?? BEYOND_M), at(k + 1, next[1] ?? BEYOND_M)],
    };
  });
}

// ERRT's plan in numbers. Pure.

import { centimetres } from '../../ui/format';
import type { PlanLayer, StateMessage } from '../../net/protocol.gen';
import { distance } from '../../lab/geometry';

export function wayLengthM(way: PlanLayer['way']): number {
  let length_m = 0;
  way.forEach((corner, index) => {
    const before = way[index - 1];
    if (before) length_m += distance(before, corner);
  });
  return length_m;
}

/** Length of the way, or what it is with it. */
export function wayWords(way: PlanLayer['way'], phase: StateMessage['phase']): string {
  if (way.length > 0) return centimetres(wayLengthM(way));
  return phase === 'transporting' ? 'searching' : 'none';
}

// Numbers of ERRT's plan. Pure.

import { centimetres } from '../../ui/format';
import type { PlanLayer, StateMessage } from '../../net/protocol.gen';
import { distance } from '../../lab/geometry';

export function pathLengthM(way: PlanLayer['way']): number {
  let length_m = 0;
  way.forEach((corner, index) => {
    const before = way[index - 1];
    if (before) length_m += distance(before, corner);
  });
  return length_m;
}

/** Length of the path, or why there is no path. */
export function pathWords(
  way: PlanLayer['way'],
  { code }: Pick<StateMessage['phase'], 'code'>,
): string {
  if (way.length > 0) return centimetres(pathLengthM(way));
  return code === 'transporting' ? 'searching' : 'none';
}

import { describe, expect, it } from 'vitest';
import { cornersOf } from '../lab/geometry';
import { TRAY_UP_M } from './tray';
import { joined, solidOf } from './traySolid';

const rect = (x_min_m: number, y_min_m: number, x_max_m: number, y_max_m: number) =>
  cornersOf({ x_min_m, y_min_m, x_max_m, y_max_m });
/** A frame of 20 × 20 cm around a room of 10 × 10 cm, and a fold that overlaps it. */
const FRAME = { exterior: rect(0, 0, 0.2, 0.2), holes: [rect(0.05, 0.05, 0.15, 0.15)] };
const FOLD = { exterior: rect(0.04, 0.09, 0.08, 0.1), holes: [] };

function facesOf(walls: Parameters<typeof joined>[0]) {
  const solid = solidOf(joined(walls));
  const { position, normal } = solid.attributes;
  let [top_m2, side_m2, wrong] = [0, 0, 0];
  const [lids] = solid.groups;
  for (let i = 0; position && normal && i < position.count; i += 3) {
    const [ax, ay, az, bx, by, bz] = [1, 2].flatMap((k) => [
      position.getX(i + k) - position.getX(i),
      position.getY(i + k) - position.getY(i),
      position.getZ(i + k) - position.getZ(i),
    ]) as [number, number, number, number, number, number];
    const across = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx] as const;
    const facing =
      across[0] * normal.getX(i) + across[1] * normal.getY(i) + across[2] * normal.getZ(i);
    if (facing < -1e-12) wrong += 1;
    // Seen from above.
    if (i < (lids?.count ?? 0)) top_m2 += across[2] / 2;
    else side_m2 += Math.hypot(...across) / 2;
  }
  const heights = Array.from({ length: position?.count ?? 0 }, (_, i) => position?.getZ(i) ?? NaN);
  return { top_m2, side_m2, wrong, heights };
}

describe('the body of the tray', () => {
  it('covers the walls, once where they overlap, and its faces look outward', () => {
    const { top_m2, side_m2, wrong, heights } = facesOf([FRAME, FOLD]);
    expect(top_m2).toBeCloseTo(0.04 - 0.01 + 0.03 * 0.01, 6);
    expect(wrong).toBe(0);
    expect(Math.min(...heights)).toBe(0);
    expect(Math.max(...heights)).toBeCloseTo(TRAY_UP_M, 6);
    // The outer side, the room, and the two long sides of the fold.
    expect(side_m2 / (0.8 + 0.4 + 2 * 0.03)).toBeCloseTo(0.022, 4);
  });

  it('has every post that stands alone', () => {
    const post = { exterior: rect(0.1, 0.1, 0.12, 0.12), holes: [] };
    expect(facesOf([FRAME, post]).top_m2).toBeCloseTo(0.03 + 0.0004, 6);
  });
});

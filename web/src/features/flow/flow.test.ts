import { describe, expect, it } from 'vitest';
import type { FlowField } from '../../net/protocol.gen';
import { sceneOf } from '../../lab/testing';
import { flowArrows, flowKey, flowSpacingM, flowTraps } from './flow';

const SPACING_M = 0.02;
const everywhere = () => true;
const GOAL: readonly [number, number] = [0.3, 0.1];

/** A flow at 16 × 11 grid points. */
function fieldOf(velocity: (x: number, y: number) => [number, number] | null): FlowField {
  const [columns, rows] = [16, 11];
  const places = Array.from({ length: columns * rows }, (_, place) =>
    velocity(place % columns, Math.floor(place / columns)),
  );
  return { columns, rows, origin_m: [0, 0], spacing_m: SPACING_M, velocity_m_s: places };
}

/** A flow straight to the goal, with constant speed. */
function toward(x: number, y: number): [number, number] {
  const [dx, dy] = [GOAL[0] - x * SPACING_M, GOAL[1] - y * SPACING_M];
  const length = Math.hypot(dx, dy) || 1;
  return [(0.04 * dx) / length, (0.04 * dy) / length];
}

describe('the spacing', () => {
  it('gives forty grid points across, within the server’s limits', () => {
    const square = (side_m: number) => ({ x_min_m: 0, x_max_m: side_m, y_min_m: 0, y_max_m: 0.1 });
    expect(flowSpacingM(square(0.6))).toBeCloseTo(0.015);
    expect(flowSpacingM(square(0.1))).toBe(0.005);
    expect(flowSpacingM(square(9))).toBe(0.05);
  });
});

describe('the key', () => {
  it('changes only with the goal and the parameters', () => {
    const scene = sceneOf('posts');
    const key = flowKey(scene, [1, 2, 0]);
    expect(flowKey({ ...scene, kept_runs: [] }, [1, 2, 0])).toBe(key);
    expect(flowKey(scene, [1, 3, 0])).not.toBe(key);
    const parameters = { ...scene.parameters, attractor_gain: 3 };
    expect(flowKey({ ...scene, parameters }, [1, 2, 0])).not.toBe(key);
    expect(flowKey({ ...scene, trial: 1 }, [1, 2, 0])).not.toBe(key);
  });
});

describe('the arrows', () => {
  it('grow with the speed and never reach the next grid point', () => {
    const arrows = flowArrows(
      fieldOf((x, y) => (y > 0 ? null : x === 0 ? [0.04, 0] : x === 1 ? [0, -0.02] : [0, 0])),
      everywhere,
    );
    const [fast, slow] = arrows.map(({ from_m, to_m }) => [
      to_m[0] - from_m[0],
      to_m[1] - from_m[1],
    ]);
    expect(arrows).toHaveLength(2);
    expect(fast?.[0]).toBeGreaterThan(0.5 * SPACING_M);
    expect(fast?.[0]).toBeLessThan(SPACING_M);
    expect(slow?.[1]).toBeCloseTo(-0.5 * (fast?.[0] ?? 0));
  });

  it('are missing where the flow is zero', () => {
    expect(
      flowArrows(
        fieldOf(() => [0, 0]),
        everywhere,
      ),
    ).toEqual([]);
    expect(
      flowArrows(
        fieldOf(() => null),
        everywhere,
      ),
    ).toEqual([]);
  });
});

describe('the traps', () => {
  it('are missing in open space', () => {
    expect(flowTraps(fieldOf(toward), GOAL, everywhere)).toEqual([]);
  });

  it('are where the flow is zero away from the goal', () => {
    const traps = flowTraps(
      fieldOf((x, y) => (x === 3 && y === 5 ? [0, 0] : toward(x, y))),
      GOAL,
      everywhere,
    );
    expect(traps).toHaveLength(1);
    expect(traps[0]?.[0]).toBeCloseTo(3 * SPACING_M);
    expect(traps[0]?.[1]).toBeCloseTo(5 * SPACING_M);
  });

  it('are missing outside the observed area', () => {
    const field = fieldOf((x, y) => (x === 3 && y === 5 ? [0, 0] : toward(x, y)));
    expect(flowTraps(field, GOAL, ([x_m]) => x_m > 4 * SPACING_M)).toEqual([]);
  });

  it('are in a pocket whose walls push back, although no speed is zero', () => {
    // In front of a wall, the flow turns back and toward the middle of the wall.
    const traps = flowTraps(
      fieldOf((x, y) => {
        if (x === 8) return y >= 2 && y <= 8 ? null : toward(x, y);
        if (x === 7 && y >= 2 && y <= 8) return [-0.04, y < 5 ? 0.02 : y > 5 ? -0.02 : 0];
        return toward(x, y);
      }),
      GOAL,
      everywhere,
    );
    expect(traps.length).toBeGreaterThan(0);
    for (const [x_m] of traps) expect(Math.abs(x_m / SPACING_M - 6.5)).toBeLessThan(1.6);
  });

  it('are where the flow circles', () => {
    const traps = flowTraps(
      fieldOf((x, y) => {
        const [dx, dy] = [x - 4, y - 5];
        return Math.hypot(dx, dy) > 2
          ? toward(x, y)
          : [-dy * 0.02 - dx * 0.01, dx * 0.02 - dy * 0.01];
      }),
      GOAL,
      everywhere,
    );
    expect(traps.length).toBeGreaterThan(0);
  });
});

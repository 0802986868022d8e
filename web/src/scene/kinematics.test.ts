import { Matrix4 } from 'three';
import { expect, test } from 'vitest';
import { linkFrames, toolTurn } from './kinematics';

/** Joint angles, and the flange that `POST /api/kinematics/forward` of the server returns. */
const FLANGES: { joints_rad: number[]; position_m: number[]; rotation: number[][] }[] = [
  {
    joints_rad: [0, 0, 0, 0, 0, 0],
    position_m: [-0.81725, -0.19145, -0.005491],
    rotation: [
      [1, 0, 0],
      [0, 0, -1],
      [0, 1, 0],
    ],
  },
  {
    joints_rad: [-Math.PI / 2, -Math.PI / 2, -Math.PI / 2, -Math.PI / 2, Math.PI / 2, 0],
    position_m: [-0.10915, -0.4869, 0.431859],
    rotation: [
      [-1, 0, 0],
      [0, 1, 0],
      [0, 0, -1],
    ],
  },
  {
    joints_rad: [0.3, -1.2, 1.7, -0.4, 0.9, 2.1],
    position_m: [-0.48086009689733766, -0.3165506384831575, 0.19660775857184543],
    rotation: [
      [-0.49749787971125725, -0.661727050786501, -0.5609038865440354],
      [0.2600537774446575, 0.5030912314221707, -0.8241791344743505],
      [0.8275674549664027, -0.5558925463824143, -0.078202201739513],
    ],
  },
  {
    joints_rad: [-2.5, -0.7, -1.9, 2.2, -1.1, -0.6],
    position_m: [-0.12111629749057706, 0.09236325311996677, 0.4494160869324841],
    rotation: [
      [0.34011275783363304, -0.14532016761954714, -0.9290884569522042],
      [-0.6640471855315755, -0.7366764072467233, -0.12786401524140134],
      [-0.6658563263545629, 0.6604467578004201, -0.34705249280839257],
    ],
  },
];

test('the flange has the pose that the server calculates', () => {
  const frames = Array.from({ length: 6 }, () => new Matrix4());
  for (const { joints_rad, position_m, rotation } of FLANGES) {
    linkFrames(joints_rad, frames);
    const elements = frames[5]?.elements ?? [];
    for (let row = 0; row < 3; row++) {
      expect(elements[12 + row]).toBeCloseTo(position_m[row] ?? NaN, 9);
      for (let column = 0; column < 3; column++) {
        expect(elements[4 * column + row]).toBeCloseTo(rotation[row]?.[column] ?? NaN, 9);
      }
    }
  }
});

test('the frames depend only on the given joint angles, not on earlier ones', () => {
  const frames = Array.from({ length: 6 }, () => new Matrix4());
  linkFrames([1, 2, 3, 4, 5, 6], frames);
  const first = frames.map((frame) => frame.clone());
  linkFrames([0, 0, 0, 0, 0, 0], frames);
  linkFrames([1, 2, 3, 4, 5, 6], frames);
  expect(frames).toEqual(first);
});

test('the tool turns with joint 1 and against joint 6', () => {
  const frames = Array.from({ length: 6 }, () => new Matrix4());
  const turnOf = (first: number, last: number): number => {
    linkFrames([first - 1.6, -Math.PI / 2, -Math.PI / 2, -Math.PI / 2, Math.PI / 2, last], frames);
    return toolTurn(frames[5] ?? new Matrix4());
  };
  const before_rad = turnOf(0, 0);
  expect(turnOf(0.5, 0) - before_rad).toBeCloseTo(0.5, 9);
  expect(turnOf(0, 0.5) - before_rad).toBeCloseTo(-0.5, 9);
  expect(turnOf(0, before_rad)).toBeCloseTo(0, 9);
});

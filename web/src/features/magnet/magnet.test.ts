import { describe, expect, it } from 'vitest';
import {
  breakaway,
  captureWords,
  directionOf,
  heldRatio,
  pullQuery,
  pullWords,
  reachQuery,
  reachWords,
  shownOffset,
  speedWords,
  weightWords,
} from './magnet';
import type { Parameters, PullCurve, ReachCurve } from '../../net/protocol.gen';
import { sceneOf } from '../../lab/testing';

const parameters = (change: Partial<Parameters> = {}): Parameters => ({
  ...sceneOf('posts').parameters,
  ...change,
});

const CURVE: PullCurve = {
  offset_m: [0, 0.05],
  lift_ratio: [1.2, 0.4],
  lateral_ratio: [0, 0.3],
  weight_ratio: [-0.2, 0.6],
  is_lifted: [true, false],
  drag_ratio: [null, 2.5],
  capture_m: [0.02, 0.1],
};

const REACH: ReachCurve = {
  lower_face_height_m: [0.1, 0.2],
  capture_m: [[0.0044, 0.0947], null],
  lift_ratio: [0.81, 0.06],
  greatest_lift_ratio: [0.81, 0.06],
  largest_speed_m_s: [0.079, null],
  lift_off_m: 0.0944,
};

describe('the breakaway', () => {
  it('equals the friction for a sliding bead', () => {
    expect(breakaway(parameters())).toBe(0.2);
  });

  it('equals the rolling resistance for a rolling bead, but is never above the friction', () => {
    expect(breakaway(parameters({ bead_motion: 'rolling' }))).toBe(0.01);
    expect(breakaway(parameters({ bead_motion: 'rolling', friction: 0.005 }))).toBe(0.005);
  });
});

describe('the requests', () => {
  it('depend on block, height, friction and direction', () => {
    const query = pullQuery(
      parameters({ block_orientation: 'B', tool_height_m: 0.12 }),
      Math.PI / 2,
    );
    expect(query).toMatchObject({
      orientation: 'B',
      lower_face_height_m: 0.12,
      friction: 0.2,
      direction_rad: Math.PI / 2,
    });
  });

  it('contain all heights or the current one, and always a drag', () => {
    const all = reachQuery(parameters({ drag_n_s_m: 0 }), 0, 'all');
    expect([all.lowest_m, all.highest_m, all.count]).toEqual([0.09, 0.2, 56]);
    expect(all.drag_n_s_m).toBeGreaterThan(0);
    const here = reachQuery(parameters(), 0, 'here');
    expect([here.lowest_m, here.highest_m]).toEqual([0.1, 0.1]);
  });
});

describe('the texts', () => {
  it('describe the capture', () => {
    expect(captureWords(null)).toBe('nothing');
    expect(captureWords([0.0044, 0.0947])).toBe('0.4 to 9.5 cm');
    expect(captureWords([0.0002, 0.261])).toBe('0.02 to 26.1 cm');
    expect(captureWords([0, 0.5])).toBe('from 0.0 cm');
  });

  it('describe the weight left', () => {
    expect(weightWords(CURVE)).toBe('none: lifts off');
    expect(weightWords({ ...CURVE, is_lifted: [false], weight_ratio: [0.19] })).toBe('19 %');
  });

  it('describe the largest speed', () => {
    expect(speedWords(REACH, parameters())).toBe('79 mm/s');
    expect(speedWords(REACH, parameters({ drag_n_s_m: 0 }))).toBe('any speed');
    expect(speedWords({ ...REACH, largest_speed_m_s: [null] }, parameters())).toBe('no speed');
  });

  it('describe a point of a curve', () => {
    expect(pullWords(CURVE, 0.2, 1)).toBe(
      '5.0 cm to the side: lift 0.40, pull 0.30, friction holds 0.12',
    );
    expect(pullWords(CURVE, 0.2, 0)).toBe('0.0 cm to the side: lift 1.20, pull 0.00, lifted off');
    expect(pullWords(CURVE, 0.2, 7)).toBeUndefined();
    expect(reachWords(REACH, 0)).toBe('At 100 mm: captures 0.4 to 9.5 cm, follows 79 mm/s');
    expect(reachWords(REACH, 1)).toBe('At 200 mm: captures nothing');
  });
});

describe('the curve', () => {
  it('has no friction where the bead lifts off', () => {
    expect(heldRatio(CURVE, 0.2)).toEqual([null, 0.12]);
  });

  it('shows the whole capture range', () => {
    expect(shownOffset(null)).toBe(0.15);
    expect(shownOffset([0, 0.0947])).toBe(0.15);
    expect(shownOffset([0, 0.14])).toBe(0.2);
    expect(shownOffset([0, 0.5])).toBe(0.5);
  });
});

describe('the direction of the curves', () => {
  it('is along a side of the block, or toward the bead in steps of 5°', () => {
    expect(directionOf('x', [0, 0], [0, 1])).toBe(0);
    expect(directionOf('y', [0, 0], [1, 0])).toBeCloseTo(Math.PI / 2);
    expect(directionOf('bead', [0.1, 0.1], [0.1, 0.05])).toBeCloseTo(-Math.PI / 2);
    expect(directionOf('bead', [0, 0], [0.05, 0.001])).toBeCloseTo(0);
    expect(directionOf('bead', [0, 0], [0, 0.0005])).toBe(0);
  });
});

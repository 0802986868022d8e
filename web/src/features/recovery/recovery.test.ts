import { expect, it } from 'vitest';
import type { RecoveryCell, RecoveryReport, RecoveryTrial } from '../../net/protocol.gen';
import {
  cellAt,
  cellWords,
  difference,
  look,
  looksOf,
  spotWords,
  squareCentimetres,
  trialWords,
} from './cells';
import { cellsMost } from './size';
import { drawingOf, nextShape } from './shapes';

const WORKSPACE = { x_min_m: -0.3, x_max_m: 0.3, y_min_m: -0.5, y_max_m: -0.2 };

const row = (part: Partial<RecoveryCell>): RecoveryCell => ({
  cell: 0,
  x_m: null,
  y_m: null,
  size_m: null,
  direction_rad: null,
  strength: null,
  at_s: null,
  controller: 'rl',
  delivered: 3,
  late: 0,
  lost: 0,
  repeats: 3,
  delivered_wilson95: [0, 1],
  time_s_median: 12.34,
  why: null,
  ...part,
});

const place = (cell: number, x_m: number, part: Partial<RecoveryCell> = {}): RecoveryCell =>
  row({ cell, x_m, y_m: -0.35, size_m: 0.02, ...part });

const report = (kind: RecoveryReport['kind'], cells: RecoveryCell[]): RecoveryReport =>
  ({ kind, cells, names: ['rl', 'errt'] }) as unknown as RecoveryReport;

it('a cell looks like what happened most often; of two, the better one', () => {
  expect(look(row({}))).toEqual({ kind: 'delivered', strength: 1 });
  expect(look(row({ delivered: 1, lost: 2, repeats: 3 })).kind).toBe('lost');
  expect(look(row({ delivered: 0, late: 2, lost: 1 })).kind).toBe('late');
  expect(look(row({ delivered: 1, lost: 1, repeats: 2 })).kind).toBe('delivered');
});

it('a difference says who delivers more, and how much', () => {
  const half = row({ delivered: 1, lost: 1, repeats: 2 });
  expect(difference(row({}), half)).toEqual({ kind: 'first', strength: 0.5 });
  expect(difference(half, row({}))).toEqual({ kind: 'second', strength: 0.5 });
  expect(difference(row({}), row({})).kind).toBe('equal');
  // A cell that has no trial of the second yet is left out.
  const cells = [place(1, 0), place(2, 0.02), place(1, 0, { controller: 'errt', delivered: 0 })];
  expect([...looksOf(report('place', cells), [0, 1]).keys()]).toEqual([1]);
  expect([...looksOf(report('place', cells), [0]).keys()]).toEqual([1, 2]);
});

it('says what happened and what was done', () => {
  const lost = row({ delivered: 1, lost: 2, why: 'lifted off', time_s_median: null });
  expect(cellWords(lost)).toBe('1 delivered, 2 not delivered (lifted off)');
  const trial = { repeat: 1, outcome: 'lost', phase: 'stopped: 150 steps', time_s: 42 };
  expect(trialWords(trial as RecoveryTrial)).toBe(
    'trial 2: not delivered (stopped: 150 steps), 42.0 s',
  );
  expect(cellWords(row({ late: 1 }))).toBe('3 delivered, 1 late; median 12.3 s');
  expect(spotWords(place(1, 0.1), 'place')).toBe('bead put to x 0.100 m, y −0.350 m');
  const push = row({ direction_rad: Math.PI / 2, strength: 0.005 });
  expect(spotWords(push, 'push')).toBe('pushed toward 90° with 5.0 mN');
  expect(spotWords({ ...push, strength: 0.08 }, 'drag')).toBe('pulled toward 90° over 8 cm');
  expect(spotWords(row({ at_s: 3, strength: 2 }), 'blind')).toBe(
    'tracker blind for 2.0 s, 3.0 s after the moment',
  );
  expect(squareCentimetres(0.0195)).toBe('195 cm²');
});

it('finds the cell of a place', () => {
  const map = report('place', [place(4, 0), place(7, 0.02)]);
  expect(cellAt(map, [0.021, -0.345])).toBe(7);
  expect(cellAt(map, [0.05, -0.35])).toBeUndefined();
});

it('arrow keys go to the nearest cell on that side', () => {
  const cells = [place(1, 0), place(2, 0.02), place(3, 0.06), place(4, 0.02, { y_m: -0.33 })];
  const { shapes } = drawingOf(report('place', cells), 'rl', WORKSPACE);
  expect(nextShape(shapes, undefined, [1, 0])).toBe(1);
  expect(nextShape(shapes, 1, [1, 0])).toBe(2);
  expect(nextShape(shapes, 2, [1, 0])).toBe(3);
  expect(nextShape(shapes, 2, [0, -1])).toBe(4);
  expect(nextShape(shapes, 3, [1, 0])).toBe(3);
});

it('draws rings of directions and rows of durations', () => {
  const strengths = [0.005, 0.01];
  const directions = [0, Math.PI];
  const pushes = strengths.flatMap((strength, ring) =>
    directions.map((direction_rad, side) =>
      row({ cell: 2 * ring + side, direction_rad, strength }),
    ),
  );
  const rings = drawingOf(report('push', pushes), 'rl', WORKSPACE).shapes;
  const radii = rings.map(({ middle: [x, y] }) => Math.round(Math.hypot(x, y)));
  expect(radii[0]).toBe(radii[1]);
  expect(radii[2]).toBeGreaterThan(radii[0] ?? Infinity);
  expect(rings[1]?.middle[0]).toBeLessThan(0);
  const losses = [0, 3].map((at_s, cell) => row({ cell, at_s, strength: 1 }));
  const { shapes, box } = drawingOf(report('blind', losses), 'rl', WORKSPACE);
  expect(shapes[1]?.middle[0]).toBeGreaterThan(shapes[0]?.middle[0] ?? Infinity);
  expect(box[2]).toBeGreaterThan(box[3]);
});

it('knows before the start how many cells there are at most', () => {
  const scene = { workspace: { x_min_m: 0, x_max_m: 0.6, y_min_m: 0, y_max_m: 0.3 }, walls: [] };
  const exterior: [number, number][] = [
    [0, 0],
    [0.3, 0],
    [0.3, 0.3],
    [0, 0.3],
  ];
  const half = { ...scene, walls: [{ exterior, holes: [] }] };
  expect(cellsMost('place', 24, scene)).toBe(24 * 12);
  expect(cellsMost('place', 24, half)).toBe(12 * 12);
  expect(cellsMost('push', 24, half)).toBe(24 * 6);
  expect(cellsMost('blind', 4, half)).toBe(4 * 4);
});

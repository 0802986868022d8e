import { expect, it } from 'vitest';
import type { MapReport } from '../net/protocol.gen';
import { freeName, mapName, reportWords } from './maps';

it.each([
  ['two-rooms.svg', 'two-rooms'],
  ['My Maze (2).SVG', 'my-maze-2'],
  ['Übung.svg', 'ubung'],
  ['__.svg', ''],
  [`${'x'.repeat(60)}.svg`, 'x'.repeat(34)],
])('%s becomes the map %s', (file, name) => {
  expect(mapName(file)).toBe(name);
});

it('numbers a name that a map has', () => {
  expect(freeName('mine', ['posts'])).toBe('mine');
  expect(freeName('mine', ['mine', 'mine-2', 'posts'])).toBe('mine-3');
});

const REPORT: MapReport = {
  name: 'mine',
  width_m: 0.58,
  height_m: 0.33,
  walls: 1,
  regions: 1,
  free_m2: 0.15,
  widest_m: 0.2,
  narrowest: null,
  reached_share: 1,
  repairs: [],
};

it('reports what a drawing holds', () => {
  expect(reportWords(REPORT)).toEqual(['580 × 330 mm, 1 wall.']);
  const narrowest = { width_m: 0.056, x_m: 0.1, y_m: -0.37 };
  const words = reportWords({ ...REPORT, regions: 2, narrowest, repairs: ['<path>: open'] });
  expect(words.slice(1)).toEqual([
    '2 separate regions: the bead cannot pass from one to the other.',
    'The narrowest place is 56 mm wide, at x 0.10, y −0.37 m.',
    'Repaired: <path>: open.',
  ]);
  expect(reportWords({ ...REPORT, reached_share: 0.43 })[1]).toBe(
    'The arm reaches 43 % of the free area.',
  );
  expect(reportWords({ ...REPORT, regions: 0 })[1]).toBe('Nowhere is there room for the bead.');
});

import { expect, it } from 'vitest';
import { fogPixels } from './fog';
import type { Palette } from '../ui/palette';

const palette = { fog: '#010203' } as Palette;
const alphas = (pixels: Uint8ClampedArray) => [...pixels].filter((_, index) => index % 4 === 3);

it('covers the cells that are unknown, with the upper row first', () => {
  // 3 columns: in the lower row only the first cell is unseen, in the upper row all but the last.
  const runs: [number, number][] = [
    [0, 1],
    [1, 2],
    [0, 2],
    [2, 1],
  ];
  const pixels = fogPixels({ columns: 3, rows: 2, runs }, palette);
  expect(alphas(pixels)).toEqual([255, 255, 0, 255, 0, 0]);
  expect([...pixels.subarray(0, 3)]).toEqual([1, 2, 3]);
});

it('covers everything before the first obstacle map', () => {
  expect([...fogPixels(undefined, palette)]).toEqual([1, 2, 3, 255]);
});

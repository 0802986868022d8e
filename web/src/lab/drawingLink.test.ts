import { expect, it } from 'vitest';
import { packed, unpacked } from './drawingLink';

const SVG = `<svg viewBox="0 0 100 50">${'<path d="M0 0L10 10"/>'.repeat(40)}Übung</svg>`;

it('packs a drawing into letters that a link may have, and back', async () => {
  const text = await packed(SVG);
  expect(text).toMatch(/^[\w-]+$/);
  expect(text.length).toBeLessThan(SVG.length / 5);
  expect(await unpacked(text)).toBe(SVG);
});

it('refuses a damaged drawing, and one that unpacks to more than a map may have', async () => {
  await expect(unpacked('abc')).rejects.toThrow('damaged');
  await expect(unpacked('%')).rejects.toThrow('damaged');
  const long = await packed(' '.repeat(5_000_000));
  expect(long.length).toBeLessThan(10_000);
  await expect(unpacked(long)).rejects.toThrow('too large');
});

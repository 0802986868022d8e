// Pictures that the page saves, and their pixels.

import { readFile } from 'node:fs/promises';
import { type Page, expect } from '@playwright/test';
import type { Lab } from './lab';
import { open } from './preconditions';

/** Pixels of a saved picture per CSS pixel. */
export const RATIO = 2;

export const box = (lab: Lab) => lab.page.getByRole('group', { name: 'Picture and video' });

/** Presses a button of the popover *Share* and returns the file that it saves. */
export async function saved(lab: Lab, button: string) {
  await open('Share')(lab);
  const downloading = lab.page.waitForEvent('download');
  await box(lab).getByRole('button', { name: button }).click();
  const download = await downloading;
  const name = download.suggestedFilename();
  await expect(box(lab).getByRole('status')).toHaveText(`Saved as ${name}.`);
  return { name, bytes: await readFile(await download.path()) };
}

interface Pixels {
  width: number;
  height: number;
  /** Number of different colours. */
  colours: number;
  isOpaque: boolean;
  /** The pixels around a place: red, green, blue, and so on. */
  around: number[][];
}

/** Decodes a picture, and reads the pixels up to `reach` around a place. */
export function decode(page: Page, png: Buffer, at: readonly [number, number], reach = 8) {
  return page.evaluate(
    async ([text, [x, y], around]): Promise<Pixels> => {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const { width, height } = image;
      const ctx = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
      if (!ctx) throw new Error('no canvas');
      ctx.drawImage(image, 0, 0);
      const all = ctx.getImageData(0, 0, width, height).data;
      const colours = new Set(new Uint32Array(all.buffer));
      const side = 2 * around;
      const near = ctx.getImageData(x - around, y - around, side, side).data;
      return {
        width,
        height,
        colours: colours.size,
        isOpaque: all.every((value, index) => index % 4 !== 3 || value === 255),
        around: Array.from({ length: side * side }, (_, i) => [...near.slice(4 * i, 4 * i + 3)]),
      };
    },
    [png.toString('base64'), at, reach] as const,
  );
}

/** A colour of the style sheet. */
export const colour = (lab: Lab, name: string) =>
  lab.page.evaluate((token) => {
    const style = getComputedStyle(document.documentElement).getPropertyValue(token);
    const ctx = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
    if (!ctx) throw new Error('no canvas');
    ctx.fillStyle = style.trim();
    ctx.fillRect(0, 0, 1, 1);
    return [...ctx.getImageData(0, 0, 1, 1).data.slice(0, 3)];
  }, name);

export const isNear = (a: readonly number[], b: readonly number[]) =>
  a.every((value, index) => Math.abs(value - (b[index] ?? NaN)) < 12);

// Draws in the map editor, as a hand does.

import type { Page } from '@playwright/test';
import type { Lab } from './lab';
import { must } from './wait';

/** Draws along places given in millimetres, as in the drawing. */
export async function drawAlong(page: Page, ...places: (readonly [number, number])[]) {
  const px = await page.locator('.draw-surface').evaluate((svg: SVGSVGElement, at) => {
    const matrix = svg.getScreenCTM() ?? undefined;
    return at.map(([x, y]) => {
      const point = new DOMPoint(x, y).matrixTransform(matrix);
      return [point.x, point.y] as const;
    });
  }, places);
  const [from, ...others] = px;
  const [x, y] = must(from, 'a place');
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (const [right, down] of others) await page.mouse.move(right, down, { steps: 5 });
  await page.mouse.up();
}

export const check = (lab: Lab) => lab.page.getByRole('status', { name: 'Check' });

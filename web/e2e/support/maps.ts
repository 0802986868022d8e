// A map to upload.

import { Buffer } from 'node:buffer';
import type { Page } from '@playwright/test';

export const DRAWING = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="-300 210 580 330">
  <circle cx="-200" cy="305" r="22"/>
  <rect x="40" y="300" width="60" height="80"/>
</svg>`;

/** Opens the file dialog by `press` and chooses a file with `text`. */
export async function openMap(
  page: Page,
  press: () => Promise<unknown>,
  text = DRAWING,
  name = 'mine.svg',
) {
  const opening = page.waitForEvent('filechooser');
  await press();
  const chooser = await opening;
  const file = { name, mimeType: 'image/svg+xml', buffer: Buffer.from(text) };
  await chooser.setFiles(file);
}

// Positions in the picture of the 3-D view, and waits until it is drawn.

import type { Lab } from './lab';
import type { Point } from './table';
import { must, until } from './wait';

export const sceneOf = (lab: Lab) => lab.label('Scene');

const boxOf = async (lab: Lab) => must(await sceneOf(lab).boundingBox(), 'the scene');

/** Waits until the 3-D view has drawn the last messages: until it draws no more frames. */
export async function settled(lab: Lab) {
  let before: number | undefined;
  let times = 0;
  await until('a picture that does not change', async () => {
    await lab.drawn();
    const now = await lab.page.evaluate(() => window.ferryGpu.frames);
    times = now === before ? times + 1 : 0;
    before = now;
    return times === 3;
  });
}

/** The homography from the table in metres to the picture in pixels: nine numbers, row by row. */
export async function projection(lab: Lab) {
  const text = await sceneOf(lab).getAttribute('data-px-from-table');
  return must(text, 'data-px-from-table').split(',').map(Number);
}

/** Numbers of buffers and textures on the graphics card. */
export async function gpuObjects(lab: Lab) {
  await settled(lab);
  return lab.page.evaluate(() => [window.ferryGpu.buffers, window.ferryGpu.textures]);
}

/** Position on the page, in CSS pixels, of a point of the table. */
export async function px(lab: Lab, [x, y]: Point): Promise<[number, number]> {
  const m = await projection(lab);
  const row = (i: number) => (m[3 * i] ?? 0) * x + (m[3 * i + 1] ?? 0) * y + (m[3 * i + 2] ?? 0);
  const box = await boxOf(lab);
  return [box.x + row(0) / row(2), box.y + row(1) / row(2)];
}

/** Position on the page of the bead's lowest point. */
export const beadPx = async (lab: Lab) => px(lab, await lab.bead());

/** A free point of the table that lies well inside the picture. */
export async function freeInPicture(lab: Lab, min_m: number, max_m: number) {
  const box = await boxOf(lab);
  for (const point of lab.freePoints(lab.state.bead_m, min_m, max_m)) {
    const [x, y] = await px(lab, point);
    // Below the buttons that cover the top of the picture.
    const isInside = x > box.x + 20 && x < box.x + box.width - 20 && y > box.y + 60;
    if (isInside && y < box.y + box.height - 20) return point;
  }
  throw new Error('no free point in the picture');
}

/** Waits until the scene camera has stopped at its new viewpoint. */
export async function cameraAtRest(lab: Lab) {
  let before: string | undefined;
  let times = 0;
  await until('a scene camera at rest', async () => {
    await lab.drawn();
    const now = (await projection(lab)).join();
    times = now === before ? times + 1 : 0;
    before = now;
    return times === 4;
  });
}

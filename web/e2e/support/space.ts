// The 3-D view: positions in its picture.

import type { Lab } from './lab';
import type { Point } from './table';
import { must, until } from './wait';

export const sceneOf = (lab: Lab) => lab.label('Scene');

async function numbers(lab: Lab, name: string) {
  const text = must(await sceneOf(lab).getAttribute(`data-${name}`), `data-${name}`);
  return text.split(',').map(Number);
}

const boxOf = async (lab: Lab) => must(await sceneOf(lab).boundingBox(), 'the scene');

/** Waits until the picture shows the last messages of the server: until no more frames are drawn. */
export async function settled(lab: Lab) {
  let before: string | null = null;
  let times = 0;
  await until('a picture that does not change', async () => {
    await lab.drawn();
    const now = await sceneOf(lab).getAttribute('data-frames');
    times = now === before ? times + 1 : 0;
    before = now;
    return times === 3;
  });
}

/** The homography from the table, in metres, to the picture, in pixels: nine numbers, row by row. */
export const projection = (lab: Lab) => numbers(lab, 'px-from-table');

/** Geometries and textures on the graphics card. */
export async function onTheCard(lab: Lab) {
  await settled(lab);
  return [...(await numbers(lab, 'geometries')), ...(await numbers(lab, 'textures'))];
}

/** Position on the page, in CSS pixels, of a point of the table. */
export async function px(lab: Lab, [x, y]: Point): Promise<[number, number]> {
  const m = await projection(lab);
  const row = (i: number) => (m[3 * i] ?? 0) * x + (m[3 * i + 1] ?? 0) * y + (m[3 * i + 2] ?? 0);
  const box = await boxOf(lab);
  return [box.x + row(0) / row(2), box.y + row(1) / row(2)];
}

export async function beadPx(lab: Lab): Promise<[number, number]> {
  const box = await boxOf(lab);
  const [x = NaN, y = NaN] = await numbers(lab, 'bead-px');
  return [box.x + x, box.y + y];
}

/** A free point to which a hand can go without leaving the picture. */
export async function freeInPicture(lab: Lab, least_m: number, most_m: number) {
  const box = await boxOf(lab);
  for (const point of lab.freePoints(lab.state.bead_m, least_m, most_m)) {
    const [x, y] = await px(lab, point);
    // Below the buttons that lie on the picture.
    const isInside = x > box.x + 20 && x < box.x + box.width - 20 && y > box.y + 60;
    if (isInside && y < box.y + box.height - 20) return point;
  }
  throw new Error('no free point in the picture');
}

/** The camera moves for a while: waits until it has arrived. */
export async function arrived(lab: Lab) {
  let before: string | undefined;
  let times = 0;
  await until('a camera at rest', async () => {
    await lab.drawn();
    const now = (await projection(lab)).join();
    times = now === before ? times + 1 : 0;
    before = now;
    return times === 4;
  });
}

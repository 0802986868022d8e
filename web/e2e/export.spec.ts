// Pictures and videos of the plan view and of the 3-D view.

import type { Page } from '@playwright/test';
import { DAILY, LONG, type Lab, expect, test } from './fixtures';
import { box, colour, decode, isNear, RATIO, saved } from './support/pictures';
import { open, openSceneView } from './support/preconditions';
import { beadPx, sceneOf, settled } from './support/scene';
import { until } from './support/wait';

/** The first bytes of a WebM file: those of EBML. */
const EBML = '1a45dfa3';
const CANNOT_RECORD = /This browser cannot record videos/;

const clock = (lab: Lab) => lab.page.getByRole('timer');

test('saves a picture of the plan view, also for a viewer', async ({ lab, openLab }) => {
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.2)[0]);
  const viewer = await openLab();
  await viewer.isRole('viewer');
  for (const one of [lab, viewer]) {
    const { name, bytes } = await saved(one, 'Picture (PNG)');
    expect(name).toBe('ferry-posts-attractor-0.0s.png');
    const { x, y, width, height } = await one.boxOf(one.canvas);
    const [beadX, beadY] = await one.px(await one.bead());
    const at = [RATIO * (beadX - x), RATIO * (beadY - y)] as const;
    const pixels = await decode(one.page, bytes, at);
    // The caption is below the view.
    expect(pixels.width).toBe(2 * Math.round((RATIO * width) / 2));
    expect(pixels.height).toBeGreaterThan(RATIO * height);
    expect(pixels.isOpaque).toBe(true);
    expect(pixels.colours).toBeGreaterThan(50);
    const bead = await colour(one, '--bead');
    expect(pixels.around.some((pixel) => isNear(pixel, bead))).toBe(true);
    const end = await decode(one.page, bytes, [pixels.width - 4, pixels.height - 4], 2);
    const surface = await colour(one, '--surface');
    expect(end.around.every((pixel) => isNear(pixel, surface))).toBe(true);
  }
});

test('saves a picture of the 3-D view', async ({ lab }) => {
  await openSceneView(lab);
  await settled(lab);
  const { x, y } = await lab.boxOf(sceneOf(lab));
  const [beadX, beadY] = await beadPx(lab);
  const { name, bytes } = await saved(lab, 'Picture (PNG)');
  expect(name).toMatch(/^ferry-posts-attractor-\d+\.\ds\.png$/);
  const at = [RATIO * (beadX - x), RATIO * (beadY - y)] as const;
  const pixels = await decode(lab.page, bytes, at);
  expect(pixels.isOpaque).toBe(true);
  expect(pixels.colours).toBeGreaterThan(200);
  // The bead is orange, in light and in shadow.
  const isOrange = ([r = 0, g = 0, b = 0]: readonly number[]) => r > g + 20 && g > b + 20;
  expect(pixels.around.some(isOrange)).toBe(true);
});

/** Plays a video in a page of its own, because Ferry's policy allows no such video. */
async function playedSize(page: Page, video: Buffer) {
  const player = await page.context().newPage();
  const size = await player.evaluate(async (text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const element = document.createElement('video');
    element.muted = true;
    element.src = URL.createObjectURL(new Blob([bytes], { type: 'video/webm' }));
    // Until there is a frame.
    await new Promise((resolve, reject) => {
      element.onloadeddata = resolve;
      element.onerror = () => {
        reject(new Error(element.error?.message));
      };
    });
    return [element.videoWidth, element.videoHeight];
  }, video.toString('base64'));
  await player.close();
  return size;
}

/** Whether the browser has an encoder; if not, checks that the page says so. */
async function canRecord(lab: Lab) {
  const can = await lab.page.evaluate(
    () => 'MediaRecorder' in window && MediaRecorder.isTypeSupported('video/webm'),
  );
  await open('Share')(lab);
  if (!can) await expect(box(lab)).toContainText(CANNOT_RECORD);
  await lab.page.keyboard.press('Escape');
  await expect(box(lab)).toHaveCount(0);
  return can;
}

/** Starts a video and waits until it has run for a second. */
async function startVideo(lab: Lab) {
  await open('Share')(lab);
  await box(lab).getByRole('button', { name: 'Record video' }).click();
  await expect(clock(lab)).toHaveText(/^0:(0[1-9]|[1-5]\d)$/);
}

for (const view of ['Plan', '3-D']) {
  const suite = view === 'Plan' ? DAILY : LONG;
  test(`records a video of the view ${view}`, suite, async ({ lab }) => {
    test.skip(!(await canRecord(lab)), 'This browser cannot record videos.');
    await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.2)[0]);
    // A software renderer draws the 3-D view slowly.
    if (view === '3-D') await lab.page.setViewportSize({ width: 700, height: 560 });
    if (view === '3-D') await openSceneView(lab);
    await lab.run();
    await startVideo(lab);
    const { name, bytes } = await saved(lab, 'Stop video');
    await expect(clock(lab)).toHaveCount(0);
    expect(name).toMatch(/^ferry-posts-attractor-\d+\.\ds\.webm$/);
    expect(bytes.subarray(0, 4).toString('hex')).toBe(EBML);
    const canvas = view === '3-D' ? sceneOf(lab) : lab.canvas;
    const { width } = await lab.boxOf(canvas);
    const [videoWidth, videoHeight] = await playedSize(lab.page, bytes);
    expect(videoWidth).toBe(2 * Math.round(width / 2));
    expect(videoHeight).toBeGreaterThan(100);
  });
}

test('saves a video when another view opens', async ({ lab }) => {
  test.skip(!(await canRecord(lab)), 'This browser cannot record videos.');
  await startVideo(lab);
  const downloading = lab.page.waitForEvent('download');
  await lab.view('Recordings').click();
  expect((await downloading).suggestedFilename()).toMatch(/\.webm$/);
});

test('says when the browser cannot record videos', async ({ lab }) => {
  await lab.page.addInitScript(() => {
    Reflect.deleteProperty(window, 'MediaRecorder');
  });
  await lab.page.reload();
  await lab.live();
  await until('the experiment', () => lab.button('Share').isEnabled());
  await open('Share')(lab);
  await expect(box(lab)).toContainText(CANNOT_RECORD);
  await expect(box(lab).getByRole('button')).toHaveText(['Picture (PNG)']);
});

// Uploaded maps: a valid drawing opens, other files are refused.

import { expect, test } from './fixtures';
import { DRAWING, openMap } from './support/maps';

const REFUSED: Record<string, { text: string; words: string }> = {
  'a drawing without a view box': {
    text: DRAWING.replace('viewBox', 'data-box'),
    words: 'viewBox',
  },
  'a text file': { text: 'no drawing at all', words: 'map' },
  'a drawing that is too large': {
    text: DRAWING.replace('</svg>', `<!--${' '.repeat(1024 * 1024)}--></svg>`),
    words: '1 MiB',
  },
};

for (const [what, { text, words }] of Object.entries(REFUSED)) {
  test(`refuses ${what} as a map`, async ({ lab, watch }) => {
    watch.allow(/Failed to load resource: .* 4\d\d /);
    await openMap(lab.page, () => lab.button('Open map…').click(), text);
    const refusal = lab.notice('transport');
    await expect(refusal.getByText(words)).toBeVisible();
    await refusal.getByRole('button', { name: 'Dismiss' }).click();
    expect(lab.sent.load_scenario).toBeUndefined();
  });
}

test('opens an uploaded map, and delivers the bead on it', async ({ lab, server }) => {
  const { page } = lab;
  await lab.map('colon');
  await openMap(page, () => lab.button('Open map…').click());
  await expect.poll(() => lab.scene.map).toMatch(/^map-/);
  const name = lab.scene.map;
  expect(lab.scene.walls.length).toBe(2);
  expect(lab.scene.maps).toContain(name);
  await expect(lab.label('Map')).toHaveValue(name);
  const stored = await page.request.get(`${server.url}/api/maps/${name}`);
  expect(await stored.text()).toBe(DRAWING);
  await lab.reset({ speed: '8', map: name });
  await lab.setGoal(lab.freePoints(await lab.bead(), 0.1, 0.2)[0]);
  await lab.run();
  await lab.delivered(1);
  await lab.pause();
  const removed = await page.request.delete(`${server.url}/api/maps/${name}`);
  expect(removed.status()).toBe(204);
  await lab.reset();
  await expect.poll(() => lab.scene.maps).not.toContain(name);
});

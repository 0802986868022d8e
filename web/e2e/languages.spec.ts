// Browsers whose language is no language tag, and browsers that are too old.

import { expect, test } from './fixtures';
import { skipFirstVisit } from './support/lab';

for (const language of ['C', 'de_DE', '']) {
  test(`opens where the language is “${language}”`, async ({ page, session }) => {
    await page.addInitScript((value) => {
      Object.defineProperty(navigator, 'language', { value });
      Object.defineProperty(navigator, 'languages', { value: [value] });
    }, language);
    await skipFirstVisit(page);
    await page.goto(session.url);
    await expect(page.locator('.plan-canvas')).toBeVisible();
    await page.getByRole('navigation', { name: 'Views' }).getByText('Recordings').click();
    await expect(page.getByRole('heading', { name: 'Recordings' })).toBeVisible();
    await page.goto(new URL('/board', session.url).href);
    await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
  });
}

test('names the browsers it needs where it cannot run', async ({ page, session }) => {
  await page.addInitScript(() => {
    Reflect.deleteProperty(Array.prototype, 'toSorted');
  });
  await page.goto(session.url);
  await expect(page.getByText('Ferry needs Firefox 121')).toBeVisible();
});

test('removes that message elsewhere', async ({ lab }) => {
  await expect(lab.page.getByText('Ferry needs Firefox 121')).toHaveCount(0);
});

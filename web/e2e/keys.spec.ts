// Keyboard shortcuts of the whole page, and announcements to assistive technology.
// The keys of the workspace are tested in laboratory.spec.ts, of the 3-D view in scene.spec.ts.

import { expect, test } from './fixtures';
import { until } from './support/wait';

const WATCHING = 'You are watching.';
const IN_CONTROL = 'You have control.';
const WORKSPACE_KEYS = 'grab or release the bead';

test('runs shortcuts anywhere, except while typing and in a dialog', async ({ lab }) => {
  const { page } = lab;
  const { keyboard } = page;
  await page.getByRole('heading', { name: 'Workspace' }).click();
  await keyboard.press('.');
  await expect(page.getByTestId('tick')).toHaveText('tick 1');
  await keyboard.press(',');
  await until('the control step', () => lab.state.tick === 32);
  // A shortcut depends on what the page shows, which is a frame behind its WebSocket.
  const speed = lab.label('Speed');
  await keyboard.press(']');
  await expect(speed).toHaveValue('2');
  await keyboard.press('[');
  await expect(speed).toHaveValue('1');
  await keyboard.press('2');
  await until('ERRT', () => lab.state.controller === 'errt');
  await keyboard.press('3');
  await until('attractor', () => lab.state.controller === 'attractor');
  await keyboard.press(' ');
  await lab.button('Pause').waitFor();
  await keyboard.press(' ');
  await lab.button('Run').waitFor();

  // While typing, shortcuts do nothing.
  const seed = lab.label('Seed');
  await seed.focus();
  for (const key of ['2', 'r', 'g']) await keyboard.press(key);
  await expect(seed).toBeFocused();
  await seed.blur();
  expect(lab.state.controller).toBe('attractor');
  expect(lab.state.tick, 'a shortcut ran while typing').toBeGreaterThan(0);

  const larger = lab.button('Larger');
  await larger.focus();
  await keyboard.press('?');
  const help = page.getByRole('dialog', { name: 'Help' });
  await expect(help.getByText(WORKSPACE_KEYS)).toBeVisible();
  await keyboard.press('r');
  await keyboard.press('Escape');
  await expect(help).toBeHidden();
  expect(lab.state.tick, 'a shortcut ran behind the dialog').toBeGreaterThan(0);
  await expect(larger).toBeFocused();
  await keyboard.press('g');
  await expect(lab.canvas).toBeFocused();
  await keyboard.press('r');
  await until('the start', () => lab.state.tick === 0);

  // Shortcuts can be switched off.
  await lab.button('Help').click();
  await help.getByRole('checkbox').uncheck();
  await keyboard.press('Escape');
  await keyboard.press('.');
  await lab.button('Step').click();
  await until('one tick only', () => lab.state.tick === 1);
  await lab.button('Help').click();
  await help.getByRole('checkbox').check();
  await help.getByRole('button', { name: 'Close' }).click();
});

test('announces events and who has control', async ({ lab, openLab }) => {
  const announced = await lab.page.getByTestId('live-region').evaluateHandle((region) => {
    const texts: string[] = [];
    new MutationObserver(() => texts.push(region.textContent.trim())).observe(region, {
      characterData: true,
      childList: true,
      subtree: true,
    });
    return texts;
  });
  const texts = () => announced.jsonValue();
  // A second page is connected, so released control stays free.
  await openLab();
  await lab.button('Disturb').click();
  await lab.page.getByLabel('Strength of the kick in mN·s').fill('0.8');
  await lab.run();
  for (let i = 0; i < 3; i++) await lab.button('Kick now').click();
  await until('the kicks', () => lab.state.disturbances >= 3);
  await lab.pause();
  await lab.releaseControl();
  await expect.poll(texts).toContain(WATCHING);
  await lab.takeControl();
  await expect.poll(texts).toContain(IN_CONTROL);
  expect((await texts()).join('|')).toContain('a kick of 0.80 mN·s');
  await expect(lab.page.getByRole('log')).toHaveAttribute('aria-live', 'off');
});

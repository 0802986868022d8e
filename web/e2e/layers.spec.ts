// Layers and panels of the magnet and the camera: capture, field, singularities, observed area.

import { type Lab, expect, test } from './fixtures';
import { SECOND_TICKS } from './support/stepper';
import { until } from './support/wait';

const summaryOf = (lab: Lab, name: string) =>
  lab.page.locator('summary').filter({ hasText: new RegExp(`^${name}`) });

/** A number of a legend, which the panel *Layers* shows below the layer. */
async function legendNumber(lab: Lab, testid: string) {
  await lab.button('Layers').click();
  const number = await lab.number(testid);
  await lab.button('Layers').click();
  return number;
}

/** The capture range as text, once the server has answered. */
function captureText(lab: Lab) {
  return until('a capture', async () => {
    const text = await lab.text('magnet-capture');
    return text !== '–' && text;
  });
}

test('updates the capture range while the friction slider is dragged', async ({ lab }) => {
  const { mouse } = lab.page;
  await lab.panel('Tune');
  expect(await captureText(lab)).toBe('0.4 to 9.5 cm');
  const sentence = lab.page.getByTestId('magnet-sentence');
  await expect(sentence).toHaveText(/^Between 0\.4 and 9\.5 cm the pull is stronger/);

  const slider = lab.page.getByRole('slider', { name: 'Friction μ slider' });
  await slider.scrollIntoViewIfNeeded();
  const box = await lab.boxOf(slider);
  const y = box.y + box.height / 2;
  // The slider reaches from 0 to 1.
  await mouse.move(box.x + 0.2 * box.width, y);
  await mouse.down();
  await mouse.move(box.x + 0.4 * box.width, y, { steps: 5 });
  await until('another capture range', async () => (await captureText(lab)) !== '0.4 to 9.5 cm');
  expect(lab.scene.parameters.friction, 'the friction before the slider is released').toBe(0.2);
  await mouse.up();
  await until('the friction', () => lab.scene.parameters.friction > 0.3);
  expect(await captureText(lab)).not.toBe('0.4 to 9.5 cm');

  await lab.restoreDefaults();
  await until('the defaults', async () => (await captureText(lab)) === '0.4 to 9.5 cm');
});

test('changes parameters of the magnet beside its curves', async ({ lab }) => {
  const { page } = lab;
  await lab.panel('Tune');
  const panel = page.getByRole('group', { name: 'Magnet and friction' });
  const weight = page.getByTestId('magnet-weight');
  await expect(weight).toContainText('%');
  const before = await weight.innerText();

  // By keyboard: one press of an arrow key is one millimetre. The field follows.
  const height = panel.getByRole('slider', { name: 'Height' });
  await height.focus();
  for (let i = 0; i < 5; i++) await page.keyboard.press('ArrowRight');
  await until('105 mm', () => Math.abs(lab.scene.parameters.tool_height_m - 0.105) < 1e-9);
  await expect(weight).not.toHaveText(before);
  const field = panel.getByRole('spinbutton', { name: 'Tool height' });
  await expect(field).toHaveValue('105');
  await field.fill('92');
  await field.press('Enter');
  await expect(weight).toContainText('lifts off');

  await summaryOf(lab, 'Magnet and bead').click();
  await page.getByRole('combobox', { name: 'Block' }).selectOption('C');
  await until('block C', () => lab.scene.parameters.block_orientation === 'C');
  await lab.radio('the bead').check();
  await lab.radio('x').check();
  await lab.restoreDefaults();
  expect(lab.scene.parameters.block_orientation).toBe('A');
});

test('shows the layer Singularity', async ({ lab }) => {
  // Far from all moving parts, and off the grid.
  const [x, y] = lab.freePoints(await lab.bead(), 0.3, 0.5)[0];
  const pixels = () => lab.pixelsAround([x + 0.007, y + 0.007]);
  const bare = await pixels();
  await lab.layer('Singularity');
  await until('the layer', async () => (await pixels()) !== bare);
  const least = await legendNumber(lab, 'heat-least');
  expect(least).toBeGreaterThanOrEqual(2);
  expect(await legendNumber(lab, 'heat-greatest')).toBeGreaterThan(least);
  await lab.layer('Singularity', false);
  await until('no layer', async () => (await pixels()) === bare);
});

test('shows the layer Field and pull', async ({ lab }) => {
  // Between the arrows, some centimetres beside the tool.
  const [x, y] = await lab.bead();
  const pixels = () => lab.pixelsAround([x + 0.04, y - 0.005]);
  const bare = await pixels();
  await lab.layer('Field and pull');
  await until('the layer', async () => (await pixels()) !== bare);
  // The dipole of the block at 10 cm; specification §2 has its pull.
  const field_mt = await legendNumber(lab, 'field-greatest');
  expect(field_mt).toBeGreaterThan(1.5);
  expect(field_mt).toBeLessThan(4);
  const pull_mn = await legendNumber(lab, 'field-pull');
  expect(pull_mn).toBeGreaterThan(1);
  expect(pull_mn).toBeLessThan(3);

  await lab.tune('Tool height', '150');
  await until(
    'a weaker field',
    async () => (await legendNumber(lab, 'field-greatest')) < 0.5 * field_mt,
  );
  await lab.restoreDefaults();
  await until(
    'the field as before',
    async () => (await legendNumber(lab, 'field-greatest')) === field_mt,
  );
  await lab.layer('Field and pull', false);
  await until('no layer', async () => (await pixels()) === bare);
});

test("shows the camera's blocks and the observed area", async ({ lab }) => {
  const { page } = lab;
  await lab.reset({ map: 'colon' });
  const blocks = page.getByTestId('blocks');
  const counts = async () => ((await blocks.textContent())?.match(/\d+/g) ?? []).map(Number);
  await expect(blocks).toContainText(/\d/);
  const [rectangles = NaN, alone = NaN] = await counts();
  expect(rectangles).toBeGreaterThan(0);
  expect(rectangles).toBeLessThan(alone);
  await lab.panel('Tune');
  await summaryOf(lab, 'Camera').click();
  await lab.tune('Smallest block', '50');
  await lab.panel('Now');
  await until('fewer blocks', async () => ((await counts())[0] ?? Infinity) < rectangles);

  // Moves the camera beside the tool and tilts it toward the tool.
  const before = JSON.stringify(lab.scene.camera_sees_m);
  await lab.panel('Tune');
  await summaryOf(lab, 'Camera').click();
  await lab.tune('Offset y', '8');
  await lab.tune('Tilt y', '-15');
  await page.getByLabel('Magnet in the picture').check();
  await until('another camera field', () => JSON.stringify(lab.scene.camera_sees_m) !== before);
  await lab.panel('Now');
  await lab.radio('rectangles').check();
  await lab.step(SECOND_TICKS);

  const [x, y] = lab.state.tool_m;
  const pixels = () => lab.pixelsAround([x + 0.25 * (x > 0 ? -1 : 1), y]);
  const bare = await pixels();
  await lab.layer('Seen so far');
  await until('the area not observed in gray', async () => (await pixels()) !== bare);
  for (const name of ['Quadtree', 'Rectangles']) await lab.layer(name);
  await lab.drawn();
  await lab.restoreDefaults();
  await until('the camera field as before', () => {
    return JSON.stringify(lab.scene.camera_sees_m) === before;
  });
});

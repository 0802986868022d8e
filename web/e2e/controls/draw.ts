// Rows of the control table: the map editor.

import { expect } from '@playwright/test';
import type { Lab } from '../support/lab';
import { DRAWING, openMap } from '../support/maps';
import { showTabs } from '../support/preconditions';
import { must, until } from '../support/wait';
import { type Row, type Section, downloads, isChecked, isPressed, valueOf, view } from './row';

const shapes = (lab: Lab) =>
  lab.page
    .locator('.draw-shape:not(.begun, .rubber)')
    .evaluateAll((all) => all.map((one) => one.getAttribute('d')));
const corners = (lab: Lab) => lab.page.locator('.draw-corner').count();
const tool = (name: string) => (lab: Lab) => lab.radio(name).click();

/** The pixel of a place in the drawing, as shares of its sides. */
async function pixel(lab: Lab, right: number, down: number): Promise<[number, number]> {
  const floor = lab.page.locator('.draw-floor');
  await floor.scrollIntoViewIfNeeded();
  const box = must(await floor.boundingBox(), 'the floor');
  return [box.x + right * box.width, box.y + down * box.height];
}

async function putPost(lab: Lab) {
  await lab.radio('Post').click();
  await lab.page.mouse.click(...(await pixel(lab, 0.4, 0.5)));
}

const selectPost = async (lab: Lab) => {
  await putPost(lab);
  await lab.radio('Move').click();
  await lab.page.mouse.click(...(await pixel(lab, 0.4, 0.5)));
};

async function beginWall(lab: Lab) {
  await lab.radio('Wall').click();
  await lab.page.mouse.click(...(await pixel(lab, 0.2, 0.2)));
}

const chosen = (from: string): Row => ({
  see: isChecked,
  ready: tool(from),
});

export const DRAW: Section = {
  name: 'the map editor',
  ready: view('Draw'),
  rows: {
    'link Draw': {
      see: (lab) => lab.page.locator('.draw-surface').count(),
      ready: view('Evaluate'),
    },
    'radio Wall': chosen('Post'),
    'radio Post': chosen('Wall'),
    'radio Area': chosen('Wall'),
    'radio Erase': chosen('Wall'),
    'radio Move': chosen('Wall'),
    'radio Start': chosen('Wall'),
    'radio Goal': chosen('Wall'),
    'slider Width': { see: valueOf, ready: tool('Wall') },
    'slider Diameter': { see: valueOf, ready: tool('Post') },
    'button Snap to 5 mm': { see: isPressed, isToggle: true },
    'combobox Symmetry': {
      see: valueOf,
      after: (lab) => lab.label('Symmetry').selectOption('none'),
    },
    'application Drawing': {
      see: shapes,
      ready: tool('Post'),
      act: async (input, locator) => {
        const { lab, page } = input;
        const at = await pixel(lab, 0.7, 0.5);
        if (input.name === 'keyboard') {
          await locator.focus();
          for (const key of ['ArrowRight', 'Enter']) await page.keyboard.press(key);
        } else if (input.name === 'touch') await page.touchscreen.tap(...at);
        else await page.mouse.click(...at);
      },
    },
    'button Undo': { see: shapes, ready: putPost },
    'button Redo': {
      see: shapes,
      ready: async (lab) => {
        await putPost(lab);
        await lab.button('Undo').click();
      },
    },
    'button Mirror left and right': { see: shapes, ready: putPost },
    'button Mirror top and bottom': {
      see: shapes,
      ready: async (lab) => {
        await lab.radio('Post').click();
        await lab.page.mouse.click(...(await pixel(lab, 0.5, 0.2)));
      },
    },
    'button Delete': { see: shapes, ready: selectPost },
    'button Finish': { see: corners, ready: beginWall },
    'button Cancel': { see: corners, ready: beginWall },
    'combobox Begin with': { see: shapes, ready: putPost },
    'button Open SVG…': {
      see: shapes,
      act: (input, locator) => openMap(input.page, () => input.press(locator), DRAWING),
    },
    'textbox Name': {
      see: valueOf,
      act: async (input, locator) => {
        await input.type(locator, `drawn-by-${input.name}`);
      },
    },
    'button Download SVG': { see: downloads },
    // Last, because it leaves the view. Other tests on this server expect the shipped maps only.
    'button Save and use': {
      see: (lab) => lab.scene.map,
      ready: (lab) => expect(lab.button('Save and use')).toBeEnabled(),
      after: async (lab) => {
        const name = lab.scene.map;
        expect(name).toContain('drawn-by-');
        await lab.page.getByRole('heading', { name: 'Set up' }).waitFor();
        await showTabs(lab);
        await lab.reset({ map: 'posts' });
        const { origin } = new URL(lab.page.url());
        expect((await lab.page.request.delete(`${origin}/api/maps/${name}`)).status()).toBe(204);
        await until('the removal of the map', () => lab.lists.maps?.includes(name) === false);
      },
    },
  },
};

// Rows of the control table: trainings and policies.

import { test } from '@playwright/test';
import type { Lab } from '../support/lab';
import { TRAIN_MS, clearTrainings, reachStage, startTraining } from '../support/trainings';
import {
  type Row,
  type Section,
  downloads,
  expanded,
  isChecked,
  isPressed,
  valueOf,
  view,
} from './row';

const originOf = (lab: Lab) => new URL(lab.page.url()).origin;

const toggle: Row = { see: isPressed, isToggle: true };
const value: Row = { see: valueOf };
const shownUpdate = (lab: Lab) => lab.page.getByTestId('train-update').first().textContent();
const shownName = (lab: Lab) => lab.page.locator('.training-head h2').first().textContent();
const panes = (lab: Lab) => lab.page.locator('.train-pane').count();

const isOpen = (lab: Lab) =>
  lab.page.locator('.train-settings').evaluate((one: HTMLDetailsElement) => one.open);

const openForm = (lab: Lab) => lab.button('New training').click();
const forms = (lab: Lab) => lab.page.locator('.train-form').count();

async function openSettings(lab: Lab) {
  await openForm(lab);
  await lab.page.locator('.train-settings').evaluate((one: HTMLDetailsElement) => {
    one.open = true;
  });
}

const inForm = (row: Row): Row => ({ ...row, ready: openForm });
const setting = (row: Row): Row => ({ ...row, ready: openSettings });

/** In turn: the first run of the section is by mouse, and each has its own server or an empty list. */
const NAMES = ['first-training', 'second-training'] as const;

export const TRAIN: Section = {
  name: 'trainings',
  ready: async (lab) => {
    const { request } = lab.page;
    test.setTimeout(test.info().timeout + NAMES.length * TRAIN_MS);
    await clearTrainings(request, originOf(lab));
    for (const name of NAMES) {
      const id = await startTraining(request, originOf(lab), name);
      await reachStage(request, originOf(lab), id, 'done');
    }
    await lab.view('Train').click();
    await lab.page.locator('.train-canvas[data-update]').waitFor();
  },
  rowReady: async (lab) => {
    const close = lab.button('Close the form');
    if (await close.isVisible()) await close.click();
  },
  after: async (lab) => {
    await clearTrainings(lab.page.request, originOf(lab));
  },
  rows: {
    'link Train': {
      see: (lab) => lab.page.locator('main.train').count(),
      ready: view('Evaluate'),
    },
    'button /^Jobs: /': { see: expanded, isToggle: true },
    'button /^Show (Evaluation|Recovery map|Training|Comparison) /': {
      elsewhere: 'lists a recovery map beside a training, pauses it and cancels the training',
    },
    'button New training': { see: forms },
    'button Close the form': { see: forms, ready: openForm },
    'combobox Map': inForm(value),
    'textbox Policy name': {
      see: valueOf,
      ready: openForm,
      act: async (input, locator) => {
        await input.type(locator, `named-by-${input.name}`);
      },
    },
    'combobox Start from': inForm(value),
    'combobox Recipe': inForm(value),
    'summary Settings': inForm({ see: isOpen, isToggle: true }),
    'spinbutton Updates': setting(value),
    'spinbutton Learning rate': setting(value),
    'spinbutton Discount': setting(value),
    'spinbutton Exploration': setting(value),
    'checkbox Noisy layers': setting({ see: isChecked, isToggle: true }),
    'spinbutton Progress reward': setting(value),
    'spinbutton Step penalty': setting(value),
    'spinbutton Steps of a return': setting(value),
    'combobox Fusion': setting(value),
    'spinbutton Seed': setting(value),
    'button Reset the settings': {
      see: (lab) => lab.spin('Seed').inputValue(),
      ready: async (lab) => {
        await openSettings(lab);
        await lab.spin('Seed').fill('7');
      },
    },
    'button Values': toggle,
    'button Best steps': toggle,
    'button Failing starts': toggle,
    'button Episodes': toggle,
    'button Curves': toggle,
    'application /^Plan of /': {
      see: (_lab, locator) => locator.getAttribute('data-cell'),
      act: async (input, locator) => {
        const { lab, page } = input;
        if (input.name === 'keyboard') {
          await locator.focus();
          await page.keyboard.press('ArrowLeft');
          return;
        }
        await locator.scrollIntoViewIfNeeded();
        const { x, y, width, height } = await lab.boxOf(locator);
        const at = [x + 0.4 * width, y + 0.6 * height] as const;
        await (input.name === 'touch' ? page.touchscreen.tap(...at) : page.mouse.click(...at));
      },
    },
    'slider /^Value map of /': { see: shownUpdate },
    'button /^(Replay|Stop) the value maps of /': {
      see: shownUpdate,
      ready: (lab) =>
        lab.page
          .getByRole('button', { name: /^Follow/ })
          .first()
          .click(),
    },
    'button /^Follow the newest value map of /': {
      see: isPressed,
      ready: async (lab) => {
        await lab.page.getByRole('slider').first().focus();
        await lab.page.keyboard.press('ArrowLeft');
      },
    },
    'button /^Compare with /': { see: panes, isToggle: true },
    'button /-training open (waits|takes images|learns|last examination|paused|done|cancelled|failed)$/':
      {
        see: shownName,
        // The newest one is the first of the list.
        ready: (lab) => lab.page.locator('.training-choose').last().click(),
      },
    'link /^Download /': { see: downloads },
    'button Watch it learn (15 s)': { elsewhere: 'learns the toy map while one watches' },
    'button Play a finished training': { elsewhere: 'learns the toy map while one watches' },
    'button /^Train ./': { elsewhere: 'trains a policy, watches it and uses it' },
    'summary /^How .* was trained$/': { elsewhere: 'trains a policy, watches it and uses it' },
    'summary How to read it': {
      see: (lab) =>
        lab.page.locator('.train-readings').evaluate((one: HTMLDetailsElement) => one.open),
      isToggle: true,
    },
    'summary How does it learn?': {
      see: (lab) =>
        lab.page.locator('.train-intro details').evaluate((one: HTMLDetailsElement) => one.open),
      isToggle: true,
    },
    'button Upload policy…': { elsewhere: 'downloads, uploads, renames and deletes a policy' },
    'button /^(Pause|Resume|Cancel|Remove) ./': {
      elsewhere: 'pauses, resumes, cancels and removes a training',
    },
    // Last, because they leave the view.
    'button /^Evaluate ./': {
      see: (lab) => lab.page.locator('main.train').count(),
      after: (lab) => lab.view('Train').click(),
    },
    'button /^Use it: /': {
      see: (lab) => lab.scene.parameters.rl_policy,
      after: async (lab) => {
        await lab.restoreDefaults();
      },
    },
  },
};

// The control table: all controls of the page by role and accessible name, and what each changes.
// A test fails when a control of the page has no row, or when a control does not change its value.

import { type Locator, type Page, expect } from '@playwright/test';
import type { InputMethod } from '../support/inputMethods';
import { isChosen, setOf } from '../support/inputMethods';
import { CHALLENGE } from './challenge';
import { DRAW } from './draw';
import { COMPARE, EVENTS, LESSONS, SHARE } from './events';
import { EXPERIMENTS, LAYERS, PLAYBACK, VIEWS, WIDE_WINDOW, WORKSPACE } from './laboratory';
import { PARAMETERS, PRESETS, SOME_PARAMETERS } from './parameters';
import { PHONE } from './phone';
import { RECOVERY } from './recovery';
import { NOT_TESTED, type Row, type Section } from './row';
import { STEER } from './steer';
import { TRAIN } from './train';
import { DISTURB, EVALUATE, MAGNET, PLOTS, RECORDINGS, SCENE_VIEW } from './tools';

const EFFECT_MS = 20_000;
const INTERVALS = [25];

type SectionsByTest = Readonly<Record<string, readonly Section[]>>;

/** The sections of each test. Small sections share a test, because opening a page takes longer than they do. */
const SECTIONS_BY_TEST: SectionsByTest = {
  'views, maps and presets': [VIEWS, WIDE_WINDOW, EXPERIMENTS, PRESETS, STEER],
  'the workspace and the playback bar': [WORKSPACE, PLAYBACK],
  'the layers and the link': [LAYERS, SHARE],
  'plots, magnet and disturbances': [PLOTS, MAGNET, DISTURB],
  'the 3-D view': [SCENE_VIEW],
  'recordings and evaluations': [RECORDINGS, EVALUATE],
  'events and comparisons': [EVENTS, COMPARE],
  'recovery maps': [RECOVERY],
  lessons: [LESSONS],
  challenges: [CHALLENGE],
  'the map editor': [DRAW],
  trainings: [TRAIN],
  'the parameters': PARAMETERS,
};

/** The mouse uses every parameter, the keyboard and touch one field of each kind. The window of touch is not wide. */
export function sectionsFor(inputMethod: string): SectionsByTest {
  if (inputMethod === 'mouse') return SECTIONS_BY_TEST;
  const some: SectionsByTest = { ...SECTIONS_BY_TEST, 'the parameters': SOME_PARAMETERS };
  if (inputMethod === 'keyboard') return some;
  return Object.fromEntries(
    Object.entries(some).map(([title, all]) => [title, all.filter((one) => one !== WIDE_WINDOW)]),
  );
}

type AriaRole = Parameters<Page['getByRole']>[0];

function parse(key: string) {
  const [role = '', ...words] = key.split(' ');
  const name = words.join(' ');
  const pattern = name.startsWith('/') ? new RegExp(name.slice(1, -1)) : undefined;
  return { role, name, pattern };
}

const literal = (text: string) => text.replaceAll(/[.*+?^${}()|[\]\\]/g, '\\$&');

function locate(page: Page, key: string): Locator {
  const { role, name, pattern } = parse(key);
  // Chromium gives summaries a role that getByRole does not know.
  if (role === 'summary') {
    return page
      .locator('summary')
      .filter({ hasText: new RegExp(`^${literal(name)}( \\d+ changed|\\d+ changed)?$`) });
  }
  // Several controls may match a pattern; the first is used. A full name has one control only.
  if (pattern) return page.getByRole(role as AriaRole, { name: pattern }).first();
  return page.getByRole(role as AriaRole, { name, exact: true });
}

/** The next number that a field accepts. */
async function nextNumber(locator: Locator) {
  const { value, step, max } = await locator.evaluate((one: HTMLInputElement) => ({
    value: Number(one.value),
    step: Number(one.dataset.step ?? 1),
    max: Number(one.getAttribute('aria-valuemax') ?? Infinity),
  }));
  const next = value + step <= max + 1e-9 ? value + step : value - step;
  return String(Number(next.toFixed(6)));
}

const press = (input: InputMethod, locator: Locator) => input.press(locator);
const pick = (input: InputMethod, locator: Locator) => input.pick(locator);

/** How a control of each role is used, unless its row has an `act`. */
const ACTS: Record<string, (input: InputMethod, locator: Locator) => Promise<unknown>> = {
  button: press,
  textbox: press,
  link: press,
  summary: press,
  checkbox: press,
  radio: pick,
  tab: pick,
  combobox: (input, locator) => input.choose(locator),
  slider: (input, locator) => input.slide(locator),
  spinbutton: async (input, locator) => input.type(locator, await nextNumber(locator)),
};

/** Chooses another radio or tab of the set. False if the set has only one. */
async function unpick(role: string, locator: Locator) {
  if (role !== 'radio' && role !== 'tab') return true;
  const [first, second] = await setOf(locator).getByRole(role).all();
  if (!first || !second) return false;
  if (await isChosen(locator)) {
    const isFirst = await first.evaluate((a, b) => a === b, await locator.elementHandle());
    await (isFirst ? second : first).click();
    await expect.poll(() => isChosen(locator), { intervals: INTERVALS }).toBe(false);
  }
  return true;
}

/** Uses a control and waits until the value in its row changes. */
export async function exercise(input: InputMethod, key: string, row: Row) {
  const { lab } = input;
  const { role } = parse(key);
  const locator = locate(lab.page, key);
  await row.ready?.(lab);
  if (!(await unpick(role, locator))) return;
  const see = async () => JSON.stringify((await row.see(lab, locator)) ?? null);
  const act = row.act ?? ACTS[role];
  if (!act) throw new Error(`no action for the role ${role}`);
  const options = { message: key, intervals: INTERVALS, timeout: EFFECT_MS };
  const before = await see();
  await act(input, locator);
  await expect.poll(see, options).not.toBe(before);
  if (row.isToggle) {
    await act(input, locator);
    await expect.poll(see, options).toBe(before);
  }
  await row.after?.(lab, input);
}

/** Titles of the tests that use a control in place of this table. */
export const ELSEWHERE = new Set(
  [...Object.values(SECTIONS_BY_TEST).flat(), PHONE]
    .flatMap(({ rows }) => Object.values(rows))
    .flatMap((row) => ('elsewhere' in row ? [row.elsewhere] : []))
    .filter((title) => title !== NOT_TESTED),
);

const ROWS = [...Object.values(SECTIONS_BY_TEST).flat(), PHONE].flatMap(({ rows }) =>
  Object.keys(rows).map((key) => ({ key, ...parse(key) })),
);

/** Whether the table has a row for this control. */
export function hasRow(control: { key: string; role: string; name: string }) {
  const { role } = control;
  // A parameter that differs from its default is marked, and so is its group.
  const [key, name] = [control.key, control.name].map((text) =>
    text.replace(/\d+ changed$| •$/, ''),
  ) as [string, string];
  // The style sheet may write the first letter large.
  const names = [name, name.slice(0, 1).toLowerCase() + name.slice(1)];
  return ROWS.some(({ pattern, ...row }) =>
    pattern ? row.role === role && names.some((one) => pattern.test(one)) : row.key === key,
  );
}

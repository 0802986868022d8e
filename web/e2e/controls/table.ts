// All controls of the page by accessible name, and what each changes. A control that is on the page and not in this
// table fails a test, and so does a row whose control changes nothing.

import { type Locator, type Page, expect } from '@playwright/test';
import type { Hand } from '../support/hands';
import { isChosen, setOf } from '../support/hands';
import { LABORATORY } from './laboratory';
import { PARAMETERS } from './parameters';
import { PAST } from './past';
import type { Row, Section } from './row';
import { TOOLS } from './tools';

const EFFECT_MS = 20_000;
const INTERVALS = [25];

export const SECTIONS: readonly Section[] = [...LABORATORY, ...TOOLS, ...PAST, ...PARAMETERS];

type AriaRole = Parameters<Page['getByRole']>[0];

function parse(key: string) {
  const [role = '', ...words] = key.split(' ');
  const name = words.join(' ');
  const pattern = name.startsWith('/') ? new RegExp(name.slice(1, -1)) : undefined;
  return { role, name, pattern };
}

function locate(page: Page, key: string): Locator {
  const { role, name, pattern } = parse(key);
  // Chromium gives summaries a role that selectors do not have.
  if (role === 'summary') {
    return page
      .locator('summary')
      .filter({ hasText: new RegExp(`^${name}( \\d+ changed|\\d+ changed)?$`) });
  }
  // Of those that a pattern matches, one; a whole name belongs to one control only.
  if (pattern) return page.getByRole(role as AriaRole, { name: pattern }).first();
  return page.getByRole(role as AriaRole, { name, exact: true });
}

/** The next number that a field takes. */
async function nextNumber(locator: Locator) {
  const { value, step, max } = await locator.evaluate((one: HTMLInputElement) => ({
    value: one.valueAsNumber,
    step: Number(one.step) || 1,
    max: one.max === '' ? Infinity : Number(one.max),
  }));
  const next = value + step <= max + 1e-9 ? value + step : value - step;
  return String(Number(next.toFixed(6)));
}

const press = (hand: Hand, locator: Locator) => hand.press(locator);
const pick = (hand: Hand, locator: Locator) => hand.pick(locator);

/** What one does with a control of a role, unless its row says otherwise. */
const ACTS: Record<string, (hand: Hand, locator: Locator) => Promise<unknown>> = {
  button: press,
  textbox: press,
  link: press,
  summary: press,
  checkbox: press,
  radio: pick,
  tab: pick,
  combobox: (hand, locator) => hand.choose(locator),
  slider: (hand, locator) => hand.slide(locator),
  spinbutton: async (hand, locator) => hand.type(locator, await nextNumber(locator)),
};

/** Of a set, another one is chosen first. False if there is no choice. */
async function unpick(role: string, locator: Locator) {
  if (role !== 'radio' && role !== 'tab') return true;
  const [first, second] = await setOf(locator).getByRole(role).all();
  if (!first || !second) return false;
  if (await isChosen(locator)) {
    const isFirst = await first.evaluate((one, it) => one === it, await locator.elementHandle());
    await (isFirst ? second : first).click();
    await expect.poll(() => isChosen(locator), { intervals: INTERVALS }).toBe(false);
  }
  return true;
}

/** Uses a control and waits for what its row says to change. */
export async function exercise(hand: Hand, key: string, row: Row) {
  const { lab } = hand;
  const { role } = parse(key);
  const locator = locate(lab.page, key);
  await row.ready?.(lab);
  if (!(await unpick(role, locator))) return;
  const see = async () => JSON.stringify((await row.see(lab, locator)) ?? null);
  const act = row.act ?? ACTS[role];
  if (!act) throw new Error(`nothing to do with a ${role}`);
  const options = { message: key, intervals: INTERVALS, timeout: EFFECT_MS };
  const before = await see();
  await act(hand, locator);
  await expect.poll(see, options).not.toBe(before);
  if (row.isToggle) {
    await act(hand, locator);
    await expect.poll(see, options).toBe(before);
  }
  await row.after?.(lab, hand);
}

const KNOWN = SECTIONS.flatMap(({ rows }) =>
  Object.keys(rows).map((key) => ({ key, ...parse(key) })),
);

/** Whether a row is about this control. */
export function isKnown({ key, role, name }: { key: string; role: string; name: string }) {
  return KNOWN.some((row) =>
    row.pattern ? row.role === role && row.pattern.test(name) : row.key === key,
  );
}

// Goes through the table of controls by one hand: acts, and waits for what the row says to change.

import { until } from './harness.mjs';
import { SECTIONS } from './controls.mjs';
import { setOf } from './hands.mjs';

const EFFECT_MS = 20_000;

/** A name may be a pattern between slashes, for those that tell what happened. */
function patternOf(name) {
  return name.startsWith('/') ? new RegExp(name.slice(1, -1)) : undefined;
}

function locate(page, key) {
  const [role, ...words] = key.split(' ');
  const name = words.join(' ');
  // Chromium knows summaries by a role that the selectors do not have.
  if (role === 'summary') {
    return page
      .locator('summary')
      .filter({ hasText: new RegExp(`^${name}( \\d+ changed|\\d+ changed)?$`) });
  }
  const pattern = patternOf(name);
  if (pattern) return page.getByRole(role, { name: pattern });
  return page.getByRole(role, { name, exact: true });
}

/** The next number that a field takes. */
async function nextNumber(locator) {
  const { value, step, max } = await locator.evaluate((one) => ({
    value: one.valueAsNumber,
    step: Number(one.step) || 1,
    max: one.max === '' ? Infinity : Number(one.max),
  }));
  const next = value + step <= max + 1e-9 ? value + step : value - step;
  return String(Number(next.toFixed(6)));
}

/** What one does with a control of such a role, unless its row says otherwise. */
const ACTS = {
  button: (hand, locator) => hand.press(locator),
  textbox: (hand, locator) => hand.press(locator),
  link: (hand, locator) => hand.press(locator),
  summary: (hand, locator) => hand.press(locator),
  checkbox: (hand, locator) => hand.press(locator),
  radio: (hand, locator) => hand.pick(locator),
  tab: (hand, locator) => hand.pick(locator),
  combobox: (hand, locator) => hand.choose(locator),
  slider: (hand, locator) => hand.slide(locator),
  spinbutton: async (hand, locator) => hand.type(locator, await nextNumber(locator)),
};

/** Of a set, another one is chosen first. Says whether there is a choice at all. */
async function unpick(key, locator) {
  const role = key.split(' ')[0];
  if (role !== 'radio' && role !== 'tab') return true;
  const isChosen = () =>
    locator.evaluate((one) => one.checked || one.getAttribute('aria-selected') === 'true');
  const all = await setOf(locator).getByRole(role).all();
  if (all.length === 1) return false;
  if (await isChosen()) {
    const [first, second] = all;
    const isFirst = await first.evaluate((one, it) => one === it, await locator.elementHandle());
    await (isFirst ? second : first).click();
    await until(`not ${key}`, async () => !(await isChosen()));
  }
  return true;
}

async function exercise(hand, key, row) {
  const { lab } = hand;
  const found = locate(lab.page, key);
  // Of those that a pattern fits, one; a whole name has to be one control's alone.
  const locator = key.includes(' /') ? found.first() : found;
  if (row.elsewhere) return;
  await row.ready?.(lab);
  // Not every session has such a thing.
  if (row.least && (await locate(lab.page, key).count()) < row.least) return;
  await row.before?.(lab);
  if (!(await unpick(key, locator))) return;
  const see = async () => JSON.stringify((await row.see(lab, locator)) ?? null);
  const act = row.act ?? ACTS[key.split(' ')[0]];
  const before = await see();
  await act(hand, locator);
  await until('an effect', async () => (await see()) !== before, EFFECT_MS);
  if (row.isToggle) {
    await act(hand, locator);
    await until('its undoing', async () => (await see()) === before, EFFECT_MS);
  }
  await row.after?.(lab, hand);
}

/** Every row by `hand`. Says what failed, and goes on. */
export async function workAll(hand) {
  const faults = [];
  const tell = (where, error) => {
    faults.push(`${where} by ${hand.name}: ${error.message.split('\n')[0]}`);
  };
  for (const { ready, rowReady, rows, after } of SECTIONS) {
    await ready?.(hand.lab);
    for (const [key, row] of Object.entries(rows)) {
      for (const one of [row].flat()) {
        try {
          await rowReady?.(hand.lab);
          await exercise(hand, key, one);
        } catch (error) {
          tell(key, error);
        }
      }
    }
    await after?.(hand.lab);
  }
  return faults;
}

const ROWS = SECTIONS.flatMap(({ rows }) => Object.keys(rows)).map((key) => {
  const [role, ...words] = key.split(' ');
  return { key, role, pattern: patternOf(words.join(' ')) };
});

/** Whether some row is about this control. */
export function isKnown({ key, role, name }) {
  return ROWS.some((row) =>
    row.pattern ? row.role === role && row.pattern.test(name) : row.key === key,
  );
}

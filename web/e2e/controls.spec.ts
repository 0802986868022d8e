// The controls of the page by mouse, keyboard and touch. e2e/controls lists what each changes.

import { readFile, readdir } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { PHONE as PHONE_CONTROLS } from './controls/phone';
import { ELSEWHERE, exercise, sectionsFor } from './controls/table';
import type { Section } from './controls/row';
import { DAILY, LONG, type Lab, expect, test } from './fixtures';
import { DESKTOP, PHONE, TABLET } from './support/browser';
import { INPUT_METHODS, type InputMethod } from './support/inputMethods';

/** Costly by mouse. */
const COSTLY = [
  'trainings',
  'recordings and evaluations',
  'recovery maps',
  'lessons',
  'the parameters',
];
/** What the page draws itself; one parameter field of each kind. */
const DAILY_BY_TOUCH = ['the workspace and the playback bar', 'the map editor'];
const DAILY_BY_KEYBOARD = [...DAILY_BY_TOUCH, 'the parameters'];

function suiteOf(inputMethod: string, title: string) {
  if (inputMethod === 'mouse') return COSTLY.includes(title) ? LONG : DAILY;
  const daily = inputMethod === 'keyboard' ? DAILY_BY_KEYBOARD : DAILY_BY_TOUCH;
  return daily.includes(title) ? DAILY : LONG;
}

async function exerciseAll(lab: Lab, input: InputMethod, section: Section) {
  await section.ready?.(lab);
  for (const [key, row] of Object.entries(section.rows)) {
    if ('elsewhere' in row) continue;
    for (const one of [row].flat()) {
      await test.step(key, async () => {
        await section.rowReady?.(lab);
        await exercise(input, key, one);
      });
    }
  }
  await section.after?.(input.lab, input);
}

for (const [name, Method] of Object.entries(INPUT_METHODS)) {
  test.describe(`by ${name}`, () => {
    test.use(name === 'touch' ? TABLET : DESKTOP);

    for (const [title, sections] of Object.entries(sectionsFor(name))) {
      test(`each control of ${title} works by ${name}`, suiteOf(name, title), async ({ lab }) => {
        const input = new Method(lab);
        for (const section of sections) await exerciseAll(lab, input, section);
      });
    }
  });
}

test.describe('on a phone', () => {
  test.use({ ...PHONE, hasTouch: true });

  test('each control of the foot works by touch', async ({ lab }) => {
    await exerciseAll(lab, new INPUT_METHODS.touch(lab), PHONE_CONTROLS);
  });
});

/** The titles of all browser tests and component tests. A title may have parts that its test fills in. */
async function titles() {
  const found: RegExp[] = [];
  const web = fileURLToPath(new URL('..', import.meta.url));
  for (const folder of ['e2e', 'src']) {
    const names = await readdir(`${web}${folder}`, { recursive: true });
    for (const name of names.filter((one) => /\.(spec|test)\.tsx?$/.test(one))) {
      const text = await readFile(`${web}${folder}/${name}`, 'utf8');
      for (const [, , title = ''] of text.matchAll(/\b(?:test|it)\(\s*(['`])([^'`]+)\1/g)) {
        const literal = title.replaceAll(/[.*+?^()|[\]\\]/g, '\\$&');
        found.push(new RegExp(`^${literal.replaceAll(/\$\{[^}]+\}/g, '.+')}$`));
      }
    }
  }
  return found;
}

test('the tests exist that use a control in place of the table', async () => {
  const all = await titles();
  expect(all.length).toBeGreaterThan(100);
  const missing = [...ELSEWHERE].filter((title) => !all.some((one) => one.test(title)));
  expect(missing).toEqual([]);
});

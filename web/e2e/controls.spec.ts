// The controls of the page by mouse, keyboard and touch. e2e/controls lists what each changes.

import { exercise, sectionsFor } from './controls/table';
import type { Section } from './controls/row';
import { type Lab, test, longUnless } from './fixtures';
import { DESKTOP, TABLET } from './support/browser';
import { INPUT_METHODS, type InputMethod } from './support/inputMethods';

/**
 * Native controls need one input method a day, and the mouse is the quickest. The others use what Ferry draws and
 * handles itself. What takes trainings or evaluations is in the long suite.
 */
const DAILY: Record<string, readonly string[]> = {
  mouse: [
    'the laboratory',
    'the layers and the link',
    'plots, magnet and disturbances',
    'the 3-D view',
    'events and comparisons',
    'challenges',
    'the map editor',
    'the parameters',
  ],
  keyboard: ['the map editor'],
  touch: ['the laboratory'],
};

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
      test(
        `each control of ${title} works by ${name}`,
        longUnless(DAILY[name]?.includes(title) ?? false),
        async ({ lab }) => {
          const input = new Method(lab);
          for (const section of sections) await exerciseAll(lab, input, section);
        },
      );
    }
  });
}

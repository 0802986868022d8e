// Every control of the page by mouse, keyboard and touch. e2e/controls lists what each changes.

import { SECTIONS, exercise } from './controls/table';
import { test } from './fixtures';
import { DESKTOP, TABLET } from './support/browser';
import { INPUT_METHODS } from './support/inputMethods';

for (const [name, InputMethod] of Object.entries(INPUT_METHODS)) {
  test.describe(`by ${name}`, () => {
    test.use(name === 'touch' ? TABLET : DESKTOP);

    for (const section of SECTIONS) {
      test(`each control of ${section.name} works by ${name}`, async ({ lab }) => {
        const input = new InputMethod(lab);
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
      });
    }
  });
}

// Every control of the page, used by each hand: it changes what its row says.

import { SECTIONS, exercise } from './controls/table';
import { test } from './fixtures';
import { DESKTOP, TABLET } from './support/browser';
import { HANDS } from './support/hands';

for (const [name, Hand] of Object.entries(HANDS)) {
  test.describe(`by ${name}`, () => {
    test.use(name === 'touch' ? TABLET : DESKTOP);

    for (const section of SECTIONS) {
      test(`each control of ${section.name} does what it says by ${name}`, async ({ lab }) => {
        const hand = new Hand(lab);
        await section.ready?.(lab);
        for (const [key, row] of Object.entries(section.rows)) {
          if ('elsewhere' in row) continue;
          for (const one of [row].flat()) {
            await test.step(key, async () => {
              await section.rowReady?.(lab);
              await exercise(hand, key, one);
            });
          }
        }
      });
    }
  });
}

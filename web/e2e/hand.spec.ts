// The latency of the hand: from the pointer to the picture, in one browser beside three sessions without one.
// Other tests run at the same time, so the time may be LENIENCY times its budget; hand.soak.spec.ts has the budget.

import { LONG, Lab, expect, test } from './fixtures';
import { HAND_BUDGET_MS, attachHand, handWords, measureHand } from './support/hand';

const LENIENCY = 3;
/** Another program may take the processors for some seconds, so the measurement is repeated. */
const ATTEMPTS = 3;
/** Fewer than in the soak: on a busy machine the other sessions must not arrive before the end. */
const INPUTS = 60;

test(
  'shows soon where the hand points',
  LONG,
  async ({ page, session, newSession, openLab }, info) => {
    test.setTimeout(ATTEMPTS * 120_000);
    await attachHand(page);
    const lab = await Lab.attach(page, session.url);
    const open = async () => {
      const { name, url } = newSession();
      return { name, lab: await openLab({ url }) };
    };
    let p95_ms = Infinity;
    for (let attempt = 0; attempt < ATTEMPTS && p95_ms > LENIENCY * HAND_BUDGET_MS; attempt++) {
      const figures = await measureHand(lab, open, INPUTS);
      info.annotations.push({ type: 'figures', description: handWords(figures) });
      p95_ms = figures['event to shown'].p95_ms;
    }
    expect(p95_ms, `${LENIENCY} times the budget`).toBeLessThanOrEqual(LENIENCY * HAND_BUDGET_MS);
  },
);

// The latency of the hand, with its budget: run nothing else meanwhile.
// `npm run soak -- hand.soak`

import { Lab, expect, test } from './fixtures';
import { writeReport } from './support/growth';
import { HAND_BUDGET_MS, attachHand, handWords, measureHand } from './support/hand';

test('shows at once where the hand points', async ({ page, session, newSession, openLab }) => {
  await attachHand(page);
  const lab = await Lab.attach(page, session.url);
  const figures = await measureHand(lab, async () => {
    const { name, url } = newSession();
    return { name, lab: await openLab({ url }) };
  });
  await writeReport('hand', figures);
  console.log(handWords(figures));
  expect(figures['event to shown'].p95_ms).toBeLessThanOrEqual(HAND_BUDGET_MS);
});

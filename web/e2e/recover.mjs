// After a test that failed: what it left must not fail the next.

import { until } from './harness.mjs';
import { Lab } from './lab.mjs';

/** Longer than an operator keeps control who is asked for it and does nothing. */
const CONTROL_MS = 45_000;

async function takeControl(lab) {
  await until(
    'the operator',
    async () => {
      if ((await lab.text('role')) === 'operator') return true;
      await lab.button('Take control').click();
      return false;
    },
    CONTROL_MS,
  );
}

async function cancelEvaluations({ page }, url) {
  const { evaluations } = await (await page.request.get(`${url}/api/evaluations`)).json();
  const live = evaluations.filter(({ stage }) => stage === 'running' || stage === 'waiting');
  for (const { id } of live) await page.request.delete(`${url}/api/evaluations/${id}`);
}

/** A page alone, as the operator, and the session as at first. */
export async function recover(context) {
  const { browser, server } = context;
  await Promise.all(browser.contexts().map((one) => one.close()));
  const lab = await Lab.open(browser, server.url);
  context.lab = lab;
  await takeControl(lab);
  await cancelEvaluations(lab, server.url);
  await lab.button('Restore defaults').click();
  await lab.page.getByRole('radio', { name: 'Attractor', exact: true }).check();
  await until('the attractor', () => lab.state.controller === 'attractor');
  // A map chosen anew has no script, no random moves and no goal.
  const other = lab.scene.map === 'open' ? 'posts' : 'open';
  await lab.reset({ map: other });
  await lab.reset();
}

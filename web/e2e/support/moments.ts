// What has to be so before a control can be used.

import { expect } from '@playwright/test';
import type { Lab } from './lab';
import { distance } from './table';
import { until } from './wait';

/** A free point near the bead, another one each time. */
export function nearby(lab: Lab) {
  const points = lab.freePoints(lab.state.bead_m, 0.05, 0.2);
  const taken = lab.state.goal_m;
  return points.find((point) => !taken || distance(point, taken) > 0.03) ?? points[0];
}

export async function pause(lab: Lab) {
  if (lab.state.running) await lab.pause();
}

export async function run(lab: Lab) {
  if (!lab.state.running) await lab.run();
}

export async function withGoal(lab: Lab) {
  if (!lab.state.goal_m) await lab.setGoal(nearby(lab));
}

export async function withoutGoal(lab: Lab) {
  if (!lab.state.goal_m) return;
  await lab.button('Clear goal').click();
  await until('no goal', () => !lab.state.goal_m);
}

export async function withHistory(lab: Lab) {
  await lab.speed('8');
  await run(lab);
  await until('a history', () => lab.state.newest_tick - lab.state.oldest_tick > 100);
  await pause(lab);
  await lab.speed('1');
}

/** Presses the button that opens something, unless it is open. */
export const open = (name: string) => async (lab: Lab) => {
  const button = lab.button(name);
  if ((await button.getAttribute('aria-expanded')) === 'false') await button.click();
};

/** The 3-D view is open and draws. */
export async function inSpace(lab: Lab) {
  await lab.radio('3-D').check();
  await expect(lab.label('Scene')).toHaveAttribute('data-bead-px', /\d/, { timeout: 30_000 });
}

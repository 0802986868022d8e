// What has to be so before a control can be worked.

import { until } from './harness.mjs';

/** A free place near the bead, another one each time. */
export function nearby(lab) {
  const points = lab.freePoints(lab.state.bead_m.slice(0, 2), 0.05, 0.2);
  const taken = lab.state.goal_m;
  return points.find(([x, y]) => !taken || Math.hypot(x - taken[0], y - taken[1]) > 0.03);
}

export async function pause(lab) {
  if (lab.state.running) await lab.pause();
}

export async function run(lab) {
  if (lab.state.running) return;
  await lab.run();
  await until('running', () => lab.state.running);
}

export async function withGoal(lab) {
  if (lab.state.goal_m) return;
  await lab.click(nearby(lab));
  await until('a goal', () => lab.state.goal_m);
}

export async function withoutGoal(lab) {
  if (!lab.state.goal_m) return;
  await lab.button('Clear goal').click();
  await until('no goal', () => !lab.state.goal_m);
}

export async function withHistory(lab) {
  await run(lab);
  await until('a history', () => lab.state.newest_tick - lab.state.oldest_tick > 100);
  await pause(lab);
}

/** Presses what opens something, unless it is open. */
export const open = (name) => async (lab) => {
  const button = lab.button(name);
  if ((await button.getAttribute('aria-expanded')) === 'false') await button.click();
};

/** The 3-D view is open and draws. */
export async function inSpace(lab) {
  const scene = lab.page.getByLabel('Scene', { exact: true });
  await until('a picture in space', () => scene.getAttribute('data-bead-px'), 30_000);
}

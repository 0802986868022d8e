import { expect, it } from 'vitest';
import { History } from './history';
import { stoodStill } from './stuck';
import { stateAt } from './testing';

const SPEED_M_S = 0.05;

/** Ten states in each second. */
function driven(x_m: (time_s: number) => number): History {
  const history = new History();
  for (let i = 0; i <= 60; i++) {
    const sim_time_s = i / 10;
    history.push(stateAt(i, { sim_time_s, tool_m: [x_m(sim_time_s), 0, 0.1] }));
  }
  return history;
}

it('a tool that moves on, or that has stood for less than three seconds, is not stuck', () => {
  expect(
    stoodStill(
      driven((time_s) => SPEED_M_S * time_s),
      6,
      SPEED_M_S,
    ),
  ).toBe(false);
  const late = driven((time_s) => SPEED_M_S * Math.min(time_s, 4.5));
  expect(stoodStill(late, 6, SPEED_M_S)).toBe(false);
});

it('a tool that stands, or goes to and fro at one place, is stuck', () => {
  expect(
    stoodStill(
      driven(() => 0.2),
      6,
      SPEED_M_S,
    ),
  ).toBe(true);
  const trembling = driven((time_s) => 0.01 * Math.sin(20 * time_s));
  expect(stoodStill(trembling, 6, SPEED_M_S)).toBe(true);
});

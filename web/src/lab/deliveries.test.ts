import { expect, it } from 'vitest';
import type { EventMessage } from '../net/protocol.gen';
import { deliveredGoals } from './deliveries';
import { eventAt } from './testingFacts';

const goal = (tick: number): EventMessage =>
  eventAt(tick, 'goal', { code: 'goal_placed', x_m: 0, y_m: 0 });
const delivered = (tick: number): EventMessage =>
  eventAt(tick, 'delivered', { code: 'delivered', distance_m: 0.01 });
const pulled = (tick: number): EventMessage => eventAt(tick, 'disturbance', { code: 'taken' });

const counted = (tick: number, deliveries: number, ...marks: EventMessage[]) =>
  deliveredGoals({ tick, deliveries }, marks);

it('counts a goal once, also when the bead is pulled away and comes again', () => {
  expect(counted(9, 1, goal(1), delivered(5))).toBe(1);
  const again = [goal(1), delivered(5), pulled(10), delivered(20)];
  expect(counted(29, 2, ...again)).toBe(1);
  expect(counted(12, 1, ...again), 'after a rewind').toBe(1);
  expect(counted(49, 3, ...again, goal(30), delivered(40))).toBe(2);
});

it('counts what the server counts where it does not know the events', () => {
  expect(counted(9, 3)).toBe(3);
  expect(deliveredGoals(undefined, [])).toBeUndefined();
});

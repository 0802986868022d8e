import { expect, it } from 'vitest';
import type { EventMessage } from '../net/protocol.gen';
import { deliveredGoals, deliveryTime_s } from './deliveries';
import { eventAt, phaseOf } from './testingFacts';

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

it('times the delivery of the present goal', () => {
  const phase = phaseOf('delivered');
  const marks = [
    goal(125),
    delivered(500),
    pulled(600),
    delivered(700),
    goal(1000),
    delivered(1500),
  ];
  expect(deliveryTime_s({ tick: 900, phase }, marks), 'after it was pulled away').toBeCloseTo(3);
  expect(deliveryTime_s({ tick: 1500, phase }, marks)).toBeCloseTo(4);
  expect(deliveryTime_s({ tick: 500, phase }, [delivered(500)]), 'a goal of the start').toBe(4);
  expect(deliveryTime_s({ tick: 1200, phase: phaseOf('transporting') }, marks)).toBeUndefined();
});

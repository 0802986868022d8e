import { expect, it } from 'vitest';
import { stateAt } from '../lab/testing';
import { phaseOf } from '../lab/testingFacts';
import { type Around, statusOf } from './status';

const AROUND: Around = { isStuck: false, isTouch: false, setsGoals: true, delivery_s: undefined };
const DELIVERED = stateAt(2000, { running: true, phase: phaseOf('delivered') });
const words = (state: typeof DELIVERED, change: Partial<Around>): string =>
  statusOf({ kind: 'live' }, undefined, state, { ...AROUND, ...change }).text;

it('says after a delivery what is next', () => {
  expect(words(DELIVERED, { delivery_s: 12.4 })).toBe(
    'Delivered in 12.4 s. Click the map to set the next goal',
  );
  expect(words(DELIVERED, { isTouch: true })).toBe('Delivered. Tap the map to set the next goal');
  expect(words(DELIVERED, { delivery_s: 12.4, setsGoals: false }), 'a viewer').toBe(
    'Delivered in 12.4 s',
  );
});

it('names the press of the device', () => {
  const idle = stateAt(0, { running: false, goal_m: null });
  expect(words(idle, { isTouch: true })).toBe('Tap the map to set a goal');
});

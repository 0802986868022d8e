import { expect, it } from 'vitest';
import { stepped } from './steps';

const UPDATES = { min: 1, max: 20_000, step: 500 };
const RATE = { min: 0, max: 0.1, step: 0.0001 };

it('goes from one round number to the next', () => {
  expect(stepped('1500', UPDATES, true)).toBe('2000');
  expect(stepped('1234', UPDATES, true)).toBe('1500');
  expect(stepped('1234', UPDATES, false)).toBe('1000');
  expect(stepped('0.0003', RATE, true)).toBe('0.0004');
  expect(stepped('0.0003', RATE, false)).toBe('0.0002');
});

it('stays inside the range, and begins at 0 without a number', () => {
  expect(stepped('300', UPDATES, false)).toBe('1');
  expect(stepped('20000', UPDATES, true)).toBe('20000');
  expect(stepped('', UPDATES, true)).toBe('500');
  expect(stepped('7', { min: 0, step: 1 }, true)).toBe('8');
});

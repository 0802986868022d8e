import { expect, it } from 'vitest';
import { numberFault, numberOf, stepped } from './number';

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

it.each([
  ['0.5', 0.5],
  ['0,5', 0.5],
  [' ,5 ', 0.5],
  ['0,005', 0.005],
  ['-1,25', -1.25],
  ['\u22123', -3],
  ['1e-3', 0.001],
  ['12,3456', 12.3456],
])('reads “%s” as %d', (text, value) => {
  expect(numberOf(text)).toBe(value);
  expect(numberFault(text)).toBeUndefined();
});

it.each([
  ['', 'Type a number.'],
  ['0,5,5', '“0,5,5” is not a number.'],
  ['1.000,5', '“1.000,5” is not a number.'],
  ['0x10', '“0x10” is not a number.'],
  ['Infinity', '“Infinity” is not a number.'],
  ['1e999', '“1e999” is not a number.'],
  ['20,000', '“20,000” is unclear: type 20.000 or 20000.'],
])('says why “%s” is not read', (text, why) => {
  expect(numberFault(text)).toBe(why);
});

it('says which numbers are allowed', () => {
  expect(numberFault('0', { min: 0.01, max: 2 })).toBe('“0” must be a number from 0.01 to 2.');
  expect(numberFault('1,5', { min: 0, isWhole: true })).toBe(
    '“1,5” must be a whole number from 0.',
  );
  expect(numberFault('2', { min: 0.01, max: 2, isWhole: true })).toBeUndefined();
});

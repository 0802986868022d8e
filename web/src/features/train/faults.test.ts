import { expect, it } from 'vitest';
import { faultWords } from './faults';

it('names the field that is wrong, or counts them', () => {
  expect(faultWords({ name: 'It is taken.' })).toBe('Policy name is wrong.');
  expect(faultWords({ 'settings.discount': 'no' })).toBe('Discount is wrong.');
  expect(faultWords({ name: 'no', 'settings.updates': 'no' })).toBe('2 fields are wrong.');
  expect(faultWords({})).toBeUndefined();
  // A changed field has lost its fault; a fault of the whole form has its own place.
  expect(faultWords({ name: undefined, form: 'no' })).toBeUndefined();
});

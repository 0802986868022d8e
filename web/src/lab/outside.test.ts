import { expect, it } from 'vitest';
import { isLedFromOutside } from './outside';
import { twinOf } from './testingTwin';

it('knows when no sub-controller moves the arm', () => {
  expect(isLedFromOutside({ controller: 'errt', twin: null })).toBe(false);
  expect(isLedFromOutside({ controller: 'robot', twin: null })).toBe(true);
  expect(isLedFromOutside({ controller: 'errt', twin: twinOf() })).toBe(true);
  expect(isLedFromOutside({ controller: 'errt', twin: twinOf({ is_driven: true }) })).toBe(false);
});

import { expect, it } from 'vitest';
import type { TwinStanding } from '../net/protocol.gen';
import { isLedFromOutside } from './outside';

const twin: TwinStanding = {
  address: '192.168.0.5',
  allows_motion: true,
  trouble: null,
  robot_mode: 7,
  safety_mode: 1,
  is_held: false,
  is_driven: false,
  stopped: null,
};

it('knows when no sub-controller moves the arm', () => {
  expect(isLedFromOutside({ controller: 'errt', twin: null })).toBe(false);
  expect(isLedFromOutside({ controller: 'robot', twin: null })).toBe(true);
  expect(isLedFromOutside({ controller: 'errt', twin })).toBe(true);
  expect(isLedFromOutside({ controller: 'errt', twin: { ...twin, is_driven: true } })).toBe(false);
});

// A mirrored robot for the unit tests.

import type { TwinStanding } from '../net/protocol.gen';

export function twinOf(change: Partial<TwinStanding> = {}): TwinStanding {
  return {
    address: '192.168.0.5',
    allows_motion: true,
    trouble: null,
    model: null,
    doubt: null,
    robot_mode: 7,
    safety_mode: 1,
    is_held: false,
    is_driven: false,
    stopped: null,
    ...change,
  };
}

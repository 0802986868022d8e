import { expect, it } from 'vitest';
import { runWords } from './runs';

const RUN = {
  number: 2,
  map: 'colon',
  seed: 7,
  controller: 'rl',
  sim_time_s: 92,
  deliveries: 0,
} as const;

it('describes a kept run', () => {
  expect(runWords(RUN)).toBe('colon, seed 7, 1:32.0, not delivered, last controller RL');
  expect(runWords({ ...RUN, deliveries: 1 })).toContain('delivered 1×');
});

import { expect, it } from 'vitest';
import { stateAt } from './testing';
import { eventAt } from './testingFacts';
import { trackedWords } from './tracked';

const placed = eventAt(40, 'disturbance', { code: 'placed', distance_m: 0.1 });
const wordsAt = (tick: number, running: boolean): string =>
  trackedWords({
    state: () => stateAt(tick, { running, tracked_error_m: 0.021 }),
    marks: () => [placed],
  });

it('the tracker has not seen a bead that was moved while paused', () => {
  expect(wordsAt(39, false)).toBe('2.1 cm');
  expect(wordsAt(40, false)).toBe('–');
  expect(wordsAt(40, true)).toBe('2.1 cm');
  expect(wordsAt(41, false)).toBe('2.1 cm');
});

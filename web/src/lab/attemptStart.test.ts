import { expect, it } from 'vitest';
import type { EventMessage, StateMessage } from '../net/protocol.gen';
import { attemptStart } from './attemptStart';

const event = (tick: number, kind: EventMessage['kind']) => ({ tick, kind }) as EventMessage;
const lab = (oldest_tick: number, marks: readonly EventMessage[]) => ({
  state: () => ({ oldest_tick }) as StateMessage,
  marks: () => marks,
});

it('is the tick of the last goal, while that is kept', () => {
  const marks = [event(10, 'goal'), event(50, 'goal'), event(90, 'stopped')];
  expect(attemptStart(lab(50, marks))).toBe(50);
  expect(attemptStart(lab(51, marks))).toBeUndefined();
});

it('is the first tick when the scenario has the goal', () => {
  expect(attemptStart(lab(0, []))).toBe(0);
  expect(attemptStart(lab(1, []))).toBeUndefined();
});

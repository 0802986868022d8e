import { expect, it } from 'vitest';
import { stateAt } from '../lab/testing';
import { happened } from './Moments';

const carrying = stateAt(10, { running: true, mode: 2, controller: 'rl', deliveries: 0 });
const after = (more: Parameters<typeof stateAt>[1]) => ({ ...carrying, tick: 11, ...more });

it('a delivery, a loss, a fetch and another controller are moments', () => {
  const delivered = after({ deliveries: 1, goal_m: [0.1, -0.3, 0] });
  expect(happened(carrying, delivered)).toMatchObject({ kind: 'delivered', at_m: [0.1, -0.3, 0] });
  const lost = after({ mode: 1 });
  expect(happened(carrying, lost)?.kind).toBe('lost');
  expect(happened(lost, { ...lost, tick: 12, mode: 2 })?.kind).toBe('fetched');
  const other = happened(carrying, after({ controller: 'errt' }));
  expect(other).toMatchObject({ kind: 'switched', words: 'ERRT' });
});

it('nothing has happened while paused, after a rewind, or when all goes on', () => {
  expect(happened(carrying, after({}))).toBeUndefined();
  expect(happened(carrying, after({ mode: 1, running: false }))).toBeUndefined();
  expect(happened(carrying, after({ mode: 1, tick: 3 }))).toBeUndefined();
});

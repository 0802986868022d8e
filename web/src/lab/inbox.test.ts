import { describe, expect, it } from 'vitest';
import { enqueue } from './inbox';
import type { Input } from './model';
import { sceneOf, stateAt } from './testing';

const state = (tick: number): Input => ({
  type: 'message',
  message: { type: 'state', ...stateAt(tick) },
});

describe('the queue before a frame', () => {
  it('keeps only the newest state, after the messages before it', () => {
    const queue: Input[] = [];
    const scene: Input = { type: 'message', message: { type: 'scene', ...sceneOf('posts') } };
    for (const input of [state(1), scene, state(2), state(3)]) enqueue(queue, input);
    expect(queue).toEqual([scene, state(3)]);
  });

  it('keeps every event', () => {
    const queue: Input[] = [];
    for (const tick of [1, 2, 3]) {
      enqueue(queue, {
        type: 'message',
        message: { type: 'event', tick, sim_time_s: 0, kind: 'goal', text: '' },
      });
    }
    expect(queue).toHaveLength(3);
  });
});

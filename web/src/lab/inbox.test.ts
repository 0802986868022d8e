import { describe, expect, it } from 'vitest';
import { Inbox } from './inbox';
import type { Input } from './model';
import { sceneOf, stateAt } from './testing';
import { eventAt } from './testingFacts';

const state = (tick: number): Input => ({
  type: 'message',
  message: { type: 'state', ...stateAt(tick) },
});

const passed = (tick: number): unknown => ({
  type: 'passed',
  state: { type: 'state', ...stateAt(tick) },
});

const scene: Input = { type: 'message', message: { type: 'scene', ...sceneOf('posts') } };

function filled(...inputs: Input[]): Inbox {
  const inbox = new Inbox();
  for (const input of inputs) inbox.add(input);
  return inbox;
}

describe('the inputs before a frame', () => {
  it('keep two states, one for each of the next frames, and tell of those before', () => {
    const inbox = filled(state(1), scene, state(2), state(3));
    expect(inbox.take()).toEqual([passed(1), scene, state(2)]);
    expect(inbox.isEmpty).toBe(false);
    expect(inbox.take()).toEqual([state(3)]);
    expect(inbox.isEmpty).toBe(true);
  });

  it('come with the state before them', () => {
    const inbox = filled(state(1), scene, state(2));
    expect(inbox.take()).toEqual([state(1), scene]);
    expect(inbox.take()).toEqual([state(2)]);
  });

  it('never lag by more than one state', () => {
    const inbox = filled();
    for (let tick = 2; tick < 40; tick += 2) {
      inbox.add(state(tick));
      inbox.add(state(tick + 1));
      expect(inbox.take().at(-1)).toEqual(state(tick));
    }
  });

  it('keep every event', () => {
    const events = [1, 2, 3].map((tick): Input => ({
      type: 'message',
      message: { type: 'event', ...eventAt(tick, 'goal') },
    }));
    expect(filled(...events).take()).toHaveLength(3);
  });
});

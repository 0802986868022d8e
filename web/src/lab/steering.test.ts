import { createRoot, createSignal } from 'solid-js';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { ClientMessage } from '../net/protocol.gen';
import { createSteering, joined } from './steering';
import { sceneOf, stateAt } from './testing';

const ATTEMPT = { walls: 0, lost_beads: 0, total_s: 9, is_time_up: false, void: null };

describe('joined', () => {
  it('adds directions and keeps a length of at most 1', () => {
    expect(joined([])).toEqual([0, 0]);
    expect(joined([[0.5, 0]])).toEqual([0.5, 0]);
    const [x, y] = joined([
      [1, 0],
      [0, 1],
    ]);
    expect(Math.hypot(x, y)).toBeCloseTo(1);
    expect(x).toBeCloseTo(y);
  });
});

describe('steering', () => {
  beforeEach(() => {
    vi.useFakeTimers();
  });
  afterEach(() => {
    vi.useRealTimers();
  });

  const open = (controller: 'you' | 'rl') => {
    const sent: ClientMessage[] = [];
    const [state, setState] = createSignal(stateAt(0, { controller, tool_m: [0.1, -0.3, 0.1] }));
    const [scene, setScene] = createSignal(sceneOf('posts', 0));
    const steering = createRoot(() =>
      createSteering({
        scene,
        state,
        canOperate: () => true,
        stream: (message) => sent.push(message),
      }),
    );
    return { steering, sent, setState, setScene };
  };

  it('points inside the workspace', () => {
    const { steering, sent } = open('you');
    steering.point([5, -0.3]);
    expect(sent).toEqual([{ type: 'steer', x_m: 0.28, y_m: -0.3, approach: false }]);
    expect(steering.target()).toEqual([0.28, -0.3]);
  });

  it('points nowhere after the end of an attempt', () => {
    const { steering, sent, setState } = open('you');
    steering.point([0.2, -0.3]);
    setState((state) => ({ ...state, attempt: { ...ATTEMPT, is_delivered: true } }));
    steering.point([0.1, -0.3]);
    expect([sent.length, steering.target()]).toEqual([1, undefined]);
  });

  it('forgets its target when the scene is sent again, as after a rewind', () => {
    const { steering, setScene } = open('you');
    steering.point([0.2, -0.3]);
    setScene(sceneOf('posts', 0));
    expect(steering.target()).toBeUndefined();
  });

  it('leans ahead of the tool until the direction ends, and then stops it', () => {
    const { steering, sent, setState } = open('you');
    steering.lean('keys', [1, 0]);
    vi.advanceTimersByTime(60);
    setState(stateAt(0, { controller: 'you', tool_m: [0.12, -0.3, 0.1] }));
    vi.advanceTimersByTime(60);
    const xs = sent.map((one) => (one.type === 'steer' ? one.x_m : NaN));
    expect(xs.at(0)).toBeCloseTo(0.125);
    expect(xs.at(-1)).toBeCloseTo(0.145);
    steering.lean('keys', [0, 0]);
    vi.advanceTimersByTime(500);
    expect(sent.at(-1)).toMatchObject({ x_m: 0.12 });
    const count = sent.length;
    vi.advanceTimersByTime(1000);
    expect(sent).toHaveLength(count);
  });

  it('does nothing for another controller', () => {
    const { steering, sent } = open('rl');
    steering.point([0.1, -0.3]);
    steering.lean('gamepad', [0, 1]);
    vi.advanceTimersByTime(200);
    expect(sent).toEqual([]);
  });
});

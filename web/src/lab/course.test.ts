import { describe, expect, it } from 'vitest';
import { BINARY_COURSE } from '../net/protocol.gen';
import { createRecorder, pointsOf } from './course';
import { CARRIERS } from '../ui/controllers';
import { History } from './history';
import type { Input } from './model';
import { sceneOf, stateAt } from './testing';
import { eventAt } from './testingFacts';

/** As the server encodes it. */
function bytesOf(step: number, first: number, count: number): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(8 + 18 * count);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, step, true);
  view.setUint32(4, first, true);
  for (let index = 0; index < count; index++) {
    [0.5, 0.25, first + step * index, 0.75].forEach((value, column) => {
      view.setFloat32(8 + 4 * (column * count + index), value, true);
    });
    view.setUint8(8 + 16 * count + index, index === 0 ? 1 : 2);
    view.setUint8(8 + 17 * count + index, 4);
  }
  return bytes;
}

function part(from_tick: number, step: number, first: number, count: number): Input {
  const bytes = bytesOf(step, first, count);
  return { type: 'course', part: { kind: BINARY_COURSE, tick: from_tick, bytes } };
}

const state = (tick: number, newest_tick = tick): Input => ({
  type: 'message',
  message: { type: 'state', ...stateAt(tick, { newest_tick }) },
});
const scene = (trial: number): Input => ({
  type: 'message',
  message: { type: 'scene', ...sceneOf('posts', trial) },
});

function recorded(...inputs: Input[]): History {
  const history = new History();
  inputs.forEach(createRecorder(history));
  return history;
}
const ticks = (history: History): number[] => [...history.window(-Infinity, Infinity).tick];

describe('the course', () => {
  it('is read as the server writes it', () => {
    const [first, second] = pointsOf(bytesOf(5, 10, 2), 0.008);
    expect(first).toMatchObject({ tick: 10, sim_time_s: 0.08, tool_x_m: 0.5, tool_y_m: 0.25 });
    expect(first).toMatchObject({ bead_x_m: 10, bead_y_m: 0.75, mode: 1, error_x_m: -9.5 });
    expect(second).toMatchObject({ tick: 15, bead_x_m: 15, mode: 2 });
    expect(CARRIERS[second?.controller ?? 0]).toBe('you');
  });

  it('is whole for a page that comes late', () => {
    expect(ticks(recorded(scene(1), part(0, 5, 5, 3), state(17)))).toEqual([5, 10, 15, 17]);
  });

  it('has no way of the bead where it was put elsewhere', () => {
    const what = { code: 'displaced', distance_m: 0.1 } as const;
    const event = { type: 'event', ...eventAt(12, 'disturbance', what) } as const;
    const history = recorded(scene(1), part(0, 5, 5, 3), { type: 'message', message: event });
    expect(history.hasJump(10, 15)).toBe(true);
    expect(history.hasJump(5, 10)).toBe(false);
    history.clear();
    expect(history.hasJump(10, 15)).toBe(false);
  });

  it('fills what lies between two states, also those that no frame has shown', () => {
    const passed: Input = { type: 'passed', state: stateAt(22) };
    const history = recorded(scene(1), state(17), passed, part(23, 5, 25, 2), state(33));
    expect(ticks(history)).toEqual([17, 22, 25, 30, 33]);
  });

  it('has what a rewind leaves ahead, until the trial goes on another way', () => {
    const joined = [scene(1), part(0, 5, 5, 4), state(10, 20)];
    expect(ticks(recorded(...joined))).toEqual([5, 10, 15, 20]);
    expect(ticks(recorded(...joined, part(11, 5, 15, 0), state(12)))).toEqual([5, 10, 12]);
    expect(ticks(recorded(...joined, state(12, 12)))).toEqual([5, 10, 12]);
  });

  it('ends with its trial', () => {
    expect(ticks(recorded(scene(1), state(17), scene(2), part(0, 5, 5, 0), state(0)))).toEqual([0]);
    expect(ticks(recorded(scene(1), state(17), scene(1)))).toEqual([17]);
  });
});

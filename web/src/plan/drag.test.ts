import { describe, expect, it } from 'vitest';
import { type DragEffect, type DragEvent, type DragState, dragStep, IDLE } from './drag';

function play(events: DragEvent[]): { state: DragState; effects: DragEffect[] } {
  let state = IDLE;
  const effects: DragEffect[] = [];
  for (const event of events) {
    const [next, out] = dragStep(state, event);
    state = next;
    effects.push(...out);
  }
  return { state, effects };
}

const down = (onBead: boolean, pointer = 1): DragEvent => ({
  type: 'down',
  pointer,
  at: [10, 10],
  onBead,
});
const move = (x: number, pointer = 1, lift = false): DragEvent => ({
  type: 'move',
  by: pointer,
  at: [x, 10],
  isBeyondSlop: Math.abs(x - 10) > 3,
  lift,
});
const up = (pointer = 1): DragEvent => ({ type: 'up', pointer });

describe('a press and release', () => {
  it('sets the goal at the press, also on the bead and with a small movement', () => {
    for (const onBead of [true, false]) {
      const { state, effects } = play([down(onBead), move(13), up()]);
      expect(state).toBe(IDLE);
      expect(effects).toEqual([{ type: 'goal', at: [10, 10] }]);
    }
  });

  it('does nothing after a longer movement beside the bead', () => {
    expect(play([down(false), move(40), up()]).effects).toEqual([]);
  });

  it('does nothing when it was cancelled', () => {
    expect(play([down(true), { type: 'cancel' }, up()]).effects).toEqual([]);
  });
});

describe('a drag of the bead', () => {
  it('begins after the threshold and releases at the end', () => {
    const { state, effects } = play([down(true), move(12), move(14), move(30), up()]);
    expect(state).toBe(IDLE);
    expect(effects).toEqual([
      { type: 'drag', at: [14, 10], lift: false },
      { type: 'drag', at: [30, 10], lift: false },
      { type: 'release' },
    ]);
  });

  it('continues when it returns to its start', () => {
    expect(play([down(true), move(20), move(10)]).state.kind).toBe('held');
  });

  it('keeps its place while the pointer is beside the table', () => {
    const beside: DragEvent = {
      type: 'move',
      by: 1,
      at: undefined,
      isBeyondSlop: true,
      lift: false,
    };
    expect(play([down(true), beside]).state.kind).toBe('pressed');
    const { state, effects } = play([down(true), move(20), beside]);
    expect(state).toMatchObject({ kind: 'held', at: [20, 10] });
    expect(effects).toHaveLength(1);
  });

  it('releases once when it is cancelled', () => {
    const { effects } = play([down(true), move(20), { type: 'cancel' }, { type: 'cancel' }, up()]);
    expect(effects.filter(({ type }) => type === 'release')).toHaveLength(1);
  });

  it('lifts when Shift changes without a move', () => {
    const { effects } = play([
      down(true),
      move(20),
      { type: 'lift', lift: true },
      { type: 'lift', lift: true },
      { type: 'lift', lift: false },
    ]);
    expect(effects.slice(1)).toEqual([
      { type: 'drag', at: [20, 10], lift: true },
      { type: 'drag', at: [20, 10], lift: false },
    ]);
  });

  it('ignores a second pointer', () => {
    const { state, effects } = play([down(true), move(20), down(false, 2), move(90, 2), up(2)]);
    expect(state.kind).toBe('held');
    expect(effects).toHaveLength(1);
  });
});

describe('the keyboard', () => {
  it('grabs, moves and releases', () => {
    const { state, effects } = play([
      { type: 'take', at: [5, 5] },
      { type: 'move', by: 'keyboard', at: [6, 5], isBeyondSlop: true, lift: false },
      move(90),
      { type: 'cancel' },
    ]);
    expect(state).toBe(IDLE);
    expect(effects.map(({ type }) => type)).toEqual(['drag', 'drag', 'release']);
  });

  it('does not grab a bead that a pointer presses', () => {
    expect(play([down(true), { type: 'take', at: [5, 5] }]).effects).toEqual([]);
  });
});

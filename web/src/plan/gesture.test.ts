import { describe, expect, it } from 'vitest';
import { type GestureEvent, REST } from './gesture';
import {
  play,
  down,
  move,
  up,
  end,
  onBead,
  steers,
  beside,
  PRESSED,
  DRAGGED,
  BY_KEYBOARD,
  STEERED,
} from './testing';

describe('a press and release', () => {
  it('chooses the place of the press, also on the bead and with a small movement', () => {
    for (const given of [onBead, {}]) {
      const { mode, effects } = play([down([10, 10], given), move([13, 10]), up()]);
      expect(mode.act.kind).toBe('idle');
      expect(mode.fingers).toEqual([]);
      expect(effects).toEqual([{ type: 'place', at: [10, 10], take: undefined }]);
    }
  });

  it('gives the place to a form that waits for one, once', () => {
    const take = (): void => undefined;
    const picking = play([{ type: 'pick', take }]).mode;
    const { mode, effects } = play([down([10, 10], steers), up(), down([9, 9]), up()], picking);
    expect(effects).toEqual([
      { type: 'place', at: [10, 10], take },
      { type: 'place', at: [9, 9], take: undefined },
    ]);
    expect(mode.take).toBeUndefined();
    const byKey = play([{ type: 'place', at: [7, 7] }], picking);
    expect(byKey.effects).toEqual([{ type: 'place', at: [7, 7], take }]);
  });

  it('is a goal again after Escape, and when the form waits no more', () => {
    const picking = play([{ type: 'pick', take: () => undefined }]).mode;
    for (const stop of [end('escape'), end('view closed'), { type: 'pick' } as const]) {
      expect(play([stop, down([1, 1]), up()], picking).effects).toEqual([
        { type: 'place', at: [1, 1], take: undefined },
      ]);
    }
  });

  it('is not allowed on the bead of another: then it moves the view', () => {
    const { types } = play([down([10, 10], { onBead: true, mayAct: false }), move([20, 10]), up()]);
    expect(types).toEqual(['refuse', 'move']);
  });

  it('chooses nothing where the view shows no table, or before there is a view', () => {
    expect(play([down([10, 10], { at: undefined }), up()]).effects).toEqual([]);
    expect(play([down([10, 10], { at: undefined, ...steers }), up()]).effects).toEqual([]);
  });
});

describe('a drag of the bead', () => {
  it('begins after the threshold and releases at the end', () => {
    const { mode, effects } = play([
      down([10, 10], onBead),
      move([12, 10]),
      move([14, 10]),
      move([10, 10], 1, true),
      up(),
    ]);
    expect(mode).toEqual(REST);
    expect(effects).toEqual([
      { type: 'drag', at: [14, 10], lift: false },
      { type: 'drag', at: [10, 10], lift: true },
      { type: 'release' },
    ]);
  });

  it('keeps its place while the pointer is beside the table', () => {
    expect(play([beside()], PRESSED).mode.act.kind).toBe('pressed');
    const { mode, effects } = play([beside()], DRAGGED);
    expect(mode.act).toMatchObject({ kind: 'held', at: [20, 10] });
    expect(effects).toEqual([]);
  });

  it('lifts when Shift changes without a move', () => {
    const lift = (to: boolean): GestureEvent => ({ type: 'lift', lift: to });
    expect(play([lift(true), lift(true), lift(false)], DRAGGED).effects).toEqual([
      { type: 'drag', at: [20, 10], lift: true },
      { type: 'drag', at: [20, 10], lift: false },
    ]);
    expect(play([lift(true)], PRESSED).effects).toEqual([]);
  });

  it('goes on with a second finger, which zooms', () => {
    const { mode, types } = play([down([50, 10], { pointer: 2 }), move([60, 10], 2)], DRAGGED);
    expect(mode.act).toMatchObject({ kind: 'held', by: 1, at: [20, 10] });
    expect(types).toEqual(['pinch']);
    expect(play([move([30, 10])], mode).types).toEqual(['drag', 'pinch']);
    expect(play([up(2), move([30, 10]), up()], mode).types).toEqual(['drag', 'release']);
  });

  it('follows a view that moves under a still pointer, without moving the view', () => {
    const { px } = DRAGGED.fingers[0] ?? { px: [0, 0] };
    const two = play([down([50, 10], { pointer: 2 })], DRAGGED).mode;
    for (const mode of [DRAGGED, two]) {
      const { effects } = play([{ ...move([0, 0]), px, at: [7, 7] } as GestureEvent], mode);
      expect(effects).toEqual([{ type: 'drag', at: [7, 7], lift: false }]);
    }
  });

  it('releases once, whatever follows', () => {
    const { types } = play([end('window left'), end('page hidden'), move([40, 10]), up()], DRAGGED);
    expect(types.filter((type) => type === 'release')).toHaveLength(1);
    expect(types).not.toContain('drag');
    expect(types).not.toContain('place');
  });
});

describe('the keyboard', () => {
  const carry: GestureEvent = { type: 'carry', at: [6, 5], lift: true };
  it('takes the bead, moves it and puts it down', () => {
    const { mode, effects } = play([carry, { type: 'put' }], BY_KEYBOARD);
    expect(effects).toEqual([{ type: 'drag', at: [6, 5], lift: true }, { type: 'release' }]);
    expect(mode).toEqual(REST);
  });

  it('neither takes nor moves a bead that a pointer has', () => {
    for (const mode of [PRESSED, DRAGGED, STEERED]) {
      const all = play([{ type: 'take', at: [5, 5] }, carry, { type: 'put' }], mode);
      expect(all).toMatchObject({ mode, effects: [] });
    }
  });

  it('keeps the bead when a pointer is pressed, which moves the view', () => {
    const { mode, types } = play([down([50, 50]), move([60, 50]), up()], BY_KEYBOARD);
    expect(mode.act).toEqual(BY_KEYBOARD.act);
    expect(types).toEqual(['move']);
  });
});

describe('the view', () => {
  it('moves with a pointer beside the bead, but not within a click', () => {
    const { mode, effects } = play([
      down([10, 10], { grip: 'shift' }),
      move([12, 10]),
      move([20, 10]),
      move([15, 11]),
      up(),
    ]);
    expect(mode).toEqual(REST);
    expect(effects).toEqual([
      { type: 'move', from: [12, 10], to: [20, 10], press: [10, 10], grip: 'shift' },
      { type: 'move', from: [20, 10], to: [15, 11], press: [10, 10], grip: 'shift' },
    ]);
  });

  it('moves with another button at once, which never chooses a place', () => {
    const right = { isMain: false, slop_px: 0, onBead: true, ...steers };
    expect(play([down([10, 10], right), move([11, 10]), up()]).types).toEqual(['move']);
    expect(play([down([10, 10], right), up()]).effects).toEqual([]);
  });

  it('is zoomed by two fingers, which neither tap nor drag', () => {
    const { mode, effects } = play([
      down([100, 100], onBead),
      down([200, 100], { pointer: 2 }),
      move([250, 100], 2),
      move([150, 100], 1),
      up(2),
      up(),
    ]);
    expect(effects).toEqual([
      { type: 'pinch', from: [200, 100], to: [250, 100], other: [100, 100] },
      { type: 'pinch', from: [100, 100], to: [150, 100], other: [250, 100] },
    ]);
    expect(mode).toEqual(REST);
  });

  it('is zoomed by the first two of three, and by the other two when one is lifted', () => {
    const { effects } = play([
      down([100, 100]),
      down([200, 100], { pointer: 2 }),
      down([300, 100], { pointer: 3 }),
      move([350, 100], 3),
      up(),
      move([400, 100], 3),
    ]);
    expect(effects).toEqual([
      { type: 'pinch', from: [350, 100], to: [400, 100], other: [200, 100] },
    ]);
  });

  it('moves with the finger that is left, once it is beyond a tap again', () => {
    const two = [down([100, 100]), down([200, 100], { pointer: 2 }), move([250, 100], 2), up()];
    expect(play([...two, move([252, 100], 2)]).types).toEqual(['pinch']);
    expect(play([...two, move([260, 100], 2)]).types).toEqual(['pinch', 'move']);
  });

  it('does not move with a pointer that is not pressed', () => {
    expect(play([move([10, 10]), move([90, 90], 7), up(7)])).toMatchObject({
      mode: REST,
      effects: [],
    });
  });
});

import { expect, it } from 'vitest';
import { type Layout, learned, readBy, UNKNOWN, wanted } from './layout';

/** As Firefox on Linux shows it: axes 2 and 5 are triggers, 6 and 7 the cross. */
const TRIGGERS_AT_REST = [0, 0, -1, 0, 0, -1, 0, 0];
const FRAME_MS = 16;

/** Shows the layout a pad for 400 ms in each state: axes by index, or the pressed button. */
function play(rest: readonly number[]) {
  let layout: Layout = UNKNOWN;
  let now_ms = 0;
  let pad = { axes: [...rest], buttons: [] as { pressed: boolean }[] };
  return {
    show: (change: Record<number, number> = {}, button?: number, for_ms = 400) => {
      pad = {
        axes: rest.map((value, axis) => change[axis] ?? value),
        buttons: Array.from({ length: 17 }, (_, index) => ({ pressed: index === button })),
      };
      for (const end_ms = now_ms + for_ms; now_ms < end_ms; now_ms += FRAME_MS)
        layout = learned(layout, pad, now_ms);
    },
    asks: () => wanted(layout),
    read: () => {
      const now = readBy(layout, pad);
      // Without the sign of 0.
      return now === 'hold' ? now : now.map((share) => share + 0);
    },
  };
}

it('rests until a direction was pushed, and follows it at once', () => {
  const pad = play(TRIGGERS_AT_REST);
  pad.show();
  expect([pad.read(), pad.asks()]).toEqual([[0, 0], 'right']);
  pad.show({ 6: 1 });
  expect(pad.read()).toEqual([1, 0]);
  pad.show();
  expect([pad.read(), pad.asks()]).toEqual([[0, 0], 'up']);
  pad.show({ 7: -1 });
  expect(pad.read()).toEqual([0, 1]);
  pad.show();
  expect(pad.asks()).toBeUndefined();
  pad.show({ 6: -1 });
  expect(pad.read()).toEqual([-1, 0]);
  pad.show({ 7: 1 });
  expect(pad.read()).toEqual([0, -1]);
  // The other sticks and the triggers do nothing.
  pad.show({ 0: 1, 3: 1, 2: 1, 5: 1 });
  expect(pad.read()).toEqual([0, 0]);
  pad.show({ 6: 1 }, 0);
  expect(pad.read()).toBe('hold');
});

it('has a cross of buttons, asked for one by one', () => {
  const pad = play([0, 0]);
  pad.show();
  for (const [button, direction] of [
    [11, 'right'],
    [13, 'up'],
    [10, 'left'],
    [12, 'down'],
  ] as const) {
    expect(pad.asks()).toBe(direction);
    pad.show({}, button);
    pad.show();
  }
  expect(pad.asks()).toBeUndefined();
  pad.show({}, 10);
  expect(pad.read()).toEqual([-1, 0]);
});

it('is not steered by a trigger, which rests at 0 only until it is touched', () => {
  const pad = play([0, 0, 0, 0]);
  pad.show();
  pad.show({ 2: 1 });
  pad.show({ 2: -1 });
  expect([pad.read(), pad.asks()]).toEqual([[0, 0], 'right']);
  // Touched a little.
  pad.show({ 2: -1, 3: -0.97 }, undefined, 4000);
  expect([pad.read(), pad.asks()]).toEqual([[0, 0], 'right']);
  pad.show({ 2: 1, 3: -0.97 });
  expect(pad.read()).toEqual([0, 0]);
  pad.show({ 0: 1, 2: -1, 3: -0.97 });
  expect(pad.read()).toEqual([1, 0]);
});

it('subtracts where the stick rests', () => {
  const pad = play([0.3, 0.3, 1.2857]);
  pad.show();
  pad.show({ 0: 1 });
  pad.show();
  pad.show({ 1: -1 });
  pad.show();
  expect([pad.read(), pad.asks()]).toEqual([[0, 0], undefined]);
});

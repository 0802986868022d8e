import { describe, expect, it } from 'vitest';
import { type GestureEvent, REST } from './gesture';
import type { End } from './release';
import {
  play,
  down,
  move,
  up,
  end,
  steers,
  PRESSED,
  DRAGGED,
  BY_KEYBOARD,
  STEERED,
} from './testing';

describe('steering', () => {
  it('follows its pointer from the press on, and no other', () => {
    const second = [down([50, 50], { pointer: 2 }), move([60, 60], 2), up(2)];
    const { mode, effects } = play([down([10, 10], steers), ...second, move([11, 10]), up()]);
    expect(effects).toEqual([
      { type: 'steer', at: [10, 10] },
      { type: 'steer', at: [11, 10] },
    ]);
    expect(mode).toEqual(REST);
  });

  it('goes on while the window is left, and ends with its pointer or with the steering', () => {
    for (const cause of ['window left', 'escape', 'other trial', 'canvas left'] as const) {
      expect(play([end(cause), move([11, 10])], STEERED).types, cause).toEqual(['steer']);
    }
    expect(play([end('pointer cancelled', 2)], STEERED).mode).toEqual(STEERED);
    for (const stop of [
      up(),
      end('pointer cancelled', 1),
      end('capture lost', 1),
      end('steering over'),
      end('view closed'),
    ]) {
      expect(play([stop, move([20, 10])], STEERED)).toEqual({
        mode: REST,
        effects: [],
        types: [],
      });
    }
  });

  it('puts down what the keyboard holds', () => {
    expect(play([down([10, 10], steers)], BY_KEYBOARD).types).toEqual(['release', 'steer']);
  });

  it('leans by the sum of the pressed arrows, and stops when the window or canvas is left', () => {
    const arrow = (key: string, isDown: boolean): GestureEvent => ({ type: 'arrow', key, isDown });
    const two = [arrow('ArrowLeft', true), arrow('ArrowUp', true)];
    expect(play([...two, arrow('ArrowLeft', false), arrow('x', false)]).effects).toEqual([
      { type: 'lean', direction: [-1, 0] },
      { type: 'lean', direction: [-1, 1] },
      { type: 'lean', direction: [0, 1] },
    ]);
    for (const cause of ['window left', 'canvas left'] as const) {
      expect(play([end(cause)], play(two).mode)).toMatchObject({
        mode: REST,
        effects: [{ type: 'lean', direction: [0, 0] }],
      });
    }
    expect(play([end('steering over')], play(two).mode)).toMatchObject({ mode: REST, effects: [] });
  });
});

describe('an end', () => {
  /** Whether each cause ends a press, a drag by pointer 1, and a hold by keyboard. */
  const ENDED: Record<End, readonly [boolean, boolean, boolean]> = {
    'control lost': [true, true, true],
    'hand silent': [true, true, true],
    'other trial': [true, true, true],
    'session rewound': [true, true, true],
    'view closed': [true, true, true],
    'window left': [true, true, true],
    'page hidden': [true, true, true],
    'pointer cancelled': [true, true, true],
    escape: [true, true, true],
    'capture lost': [true, true, false],
    'canvas left': [false, false, true],
    'steering over': [false, false, false],
  };

  it.each(Object.keys(ENDED) as End[])('because of “%s” ends the right acts', (cause) => {
    const after = [PRESSED, DRAGGED, BY_KEYBOARD].map((mode) => play([end(cause, 1)], mode));
    expect(after.map(({ mode }) => mode.act.kind === 'idle')).toEqual(ENDED[cause]);
    const [, drag, keyboard] = ENDED[cause];
    expect(after.map(({ types }) => types)).toEqual([
      [],
      drag ? ['release'] : [],
      keyboard ? ['release'] : [],
    ]);
  });

  it('does not follow from the lost capture of another pointer', () => {
    for (const mode of [REST, PRESSED, DRAGGED, BY_KEYBOARD, STEERED]) {
      expect(play([end('capture lost', 2)], mode)).toMatchObject({ mode, effects: [] });
    }
  });

  it('leaves no pointer behind when it was cancelled or lost', () => {
    for (const cause of ['pointer cancelled', 'capture lost'] as const) {
      const { mode } = play([down([5, 5], { pointer: 2 }), end(cause, 2)]);
      expect(mode).toEqual(REST);
    }
  });
});

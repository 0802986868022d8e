import { describe, expect, it } from 'vitest';
import { IDLE, type DragState } from './drag';
import { RELEASE_CAUSES, causeOf, ends, type ReleaseCause, type Watched } from './release';

const PRESSED: DragState = { kind: 'pressed', pointer: 1, from: [0, 0], onBead: true };
const DRAGGED: DragState = { kind: 'held', by: 1, at: [0, 0], lift: false };
const BY_KEYBOARD: DragState = { ...DRAGGED, by: 'keyboard' };

/** Whether each cause ends a press, a drag by pointer 1, and a hold by keyboard. */
const ENDED: Record<ReleaseCause, readonly [boolean, boolean, boolean]> = {
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
  'second finger': [true, false, false],
  'canvas left': [false, false, true],
};

describe('a release', () => {
  it.each(RELEASE_CAUSES)('because of “%s” ends the right presses and holds', (cause) => {
    expect([PRESSED, DRAGGED, BY_KEYBOARD].map((drag) => ends(cause, drag, 1))).toEqual(
      ENDED[cause],
    );
  });

  it('does not follow from the lost capture of another pointer', () => {
    for (const drag of [IDLE, PRESSED, DRAGGED]) {
      expect(ends('capture lost', drag, 2)).toBe(false);
    }
  });
});

describe('a change of the laboratory', () => {
  const BEFORE: Watched = { canOperate: true, silences: 0, trial: 1, tick: 100 };
  it.each([
    [{ canOperate: false }, 'control lost'],
    [{ silences: 1 }, 'hand silent'],
    [{ trial: 2, tick: 0 }, 'other trial'],
    [{ tick: 99 }, 'session rewound'],
    [{ tick: 101 }, undefined],
    [{}, undefined],
  ] as const)('of %o has the cause: %s', (change, cause) => {
    expect(causeOf(BEFORE, { ...BEFORE, ...change })).toBe(cause);
  });

  it('does not end the press of a viewer, because the click shows a notice', () => {
    const viewer = { ...BEFORE, canOperate: false };
    expect(causeOf(viewer, { ...viewer, tick: 101 })).toBeUndefined();
  });
});

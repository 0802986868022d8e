import { describe, expect, it } from 'vitest';
import { causeOf, type Watched } from './release';

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

import { describe, expect, it } from 'vitest';
import { type Shown, TIP_IDS, doneAfter, nextTip, tipText, tipsFrom } from './tips';

const BEFORE: Shown = {
  running: false,
  fetching: false,
  goal: '',
  controller: 'rl',
  compares: false,
  scene: false,
};

describe('tips', () => {
  it('come one at a time', () => {
    expect(nextTip(new Set(), true, false)).toBe('run');
    expect(nextTip(new Set(['run', 'goal']), true, false)).toBe('drag');
    expect(nextTip(new Set(TIP_IDS), true, false)).toBeUndefined();
  });

  it('begin with the goal if it is not set', () => {
    expect(nextTip(new Set(), false, false)).toBe('goal');
    expect(tipText('goal', false, true)).toBe('Tap a free place to set the goal.');
    expect(nextTip(new Set(['goal']), false, false)).toBe('controller');
  });

  it('do not ask for what a delivery has ended', () => {
    expect(nextTip(new Set(['run']), true, true)).toBe('controller');
  });

  it.each([
    ['run', { running: true }],
    ['drag', { fetching: true }],
    ['goal', { goal: '0.1,-0.3' }],
    ['controller', { controller: 'errt' }],
    ['controller', { compares: true }],
    ['scene', { scene: true }],
  ] as const)('%s is done by what it asks for', (id, change) => {
    expect([...doneAfter(new Set(), { ...BEFORE, ...change }, BEFORE)]).toEqual([id]);
  });

  it('are done by what is so at the first moment, but goal and controller have to change', () => {
    const first: Shown = { ...BEFORE, running: true, goal: '0.1,-0.3', scene: true };
    expect([...doneAfter(new Set(), first, first)]).toEqual(['run', 'scene']);
  });

  it('are not done by a removed goal', () => {
    expect(doneAfter(new Set(), BEFORE, { ...BEFORE, goal: '0.1,-0.3' }).size).toBe(0);
  });

  it('stay done', () => {
    expect([...doneAfter(new Set(['run']), BEFORE, BEFORE)]).toEqual(['run']);
  });

  it('are read from what is stored', () => {
    expect([...tipsFrom('drag,run,other')]).toEqual(['run', 'drag']);
    expect(tipsFrom(null).size).toBe(0);
  });
});

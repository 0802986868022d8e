import { describe, expect, it } from 'vitest';
import { RECIPES } from '../../net/protocol.gen';
import {
  BLANK,
  changeWords,
  type Draft,
  faultsOf,
  nameFault,
  queryOf,
  SETTINGS,
  settingText,
  suggestedName,
  withSetting,
} from './recipes';

const made = (draft: Draft) => queryOf(draft, 'posts', 'my-posts');

describe('a name', () => {
  it('is suggested from the map, and free', () => {
    expect(suggestedName('posts', [])).toBe('my-posts');
    expect(suggestedName('my-u', [])).toBe('my-u');
    expect(suggestedName('posts', ['my-posts', 'my-posts-2'])).toBe('my-posts-3');
    expect(nameFault(suggestedName('m'.repeat(40), [suggestedName('m'.repeat(40), [])]))).toBe(
      undefined,
    );
  });

  it.each(['', 'Posts', '-a', 'a b', 'a'.repeat(41)])('%j is refused', (name) => {
    expect(queryOf(BLANK, 'posts', name)).toEqual({ faults: { name: nameFault(name) } });
    expect(nameFault(name)).toContain('a to z');
  });
});

describe('the request', () => {
  it('has no settings that are as in the recipe', () => {
    expect(made(BLANK)).toEqual({
      query: {
        map: 'posts',
        name: 'my-posts',
        seed: 1,
        recipe: 'quick',
        settings: Object.fromEntries(SETTINGS.map(({ name }) => [name, null])),
        start_from: null,
        goal_m: null,
      },
    });
  });

  it('has the changed settings', () => {
    let draft = withSetting({ ...BLANK, recipe: 'paper', startFrom: 'colon' }, 'discount', '0.5');
    draft = withSetting(draft, 'noisy', 'false');
    draft = withSetting(draft, 'fusion', 'late');
    const answer = made(draft);
    expect(answer).toMatchObject({
      query: {
        recipe: 'paper',
        settings: { discount: 0.5, noisy: false, fusion: 'late', updates: null },
        start_from: 'colon',
      },
    });
    if ('query' in answer) {
      expect(changeWords(answer.query)).toEqual([
        'discount 0.5',
        'noisy layers off',
        'fusion late',
      ]);
    }
  });

  it('drops a change that is taken back', () => {
    const draft = withSetting(withSetting(BLANK, 'n_step', '3'), 'n_step', '1');
    expect(draft.settings).toEqual({});
    expect(settingText(draft, 'learning_rate')).toBe('0.001');
  });

  it.each([
    ['discount', '1.5'],
    ['discount', ''],
    ['updates', '0'],
    ['updates', '10.5'],
    ['n_step', '21'],
    ['learning_rate', '-1'],
  ] as const)('refuses %s %j', (name, text) => {
    const answer = made(withSetting(BLANK, name, text));
    expect('faults' in answer && Object.keys(answer.faults)).toEqual([`settings.${name}`]);
  });

  it('refuses a seed that is not a whole number', () => {
    expect(made({ ...BLANK, seed: '1.5' })).toHaveProperty('faults.seed');
  });
});

describe('a refusal', () => {
  it('is shown at its field, otherwise below the form', () => {
    const detail = 'no';
    expect(faultsOf({ detail, field: 'settings.discount' })).toEqual({ 'settings.discount': 'no' });
    expect(faultsOf({ detail, field: 'name' })).toEqual({ name: 'no' });
    expect(faultsOf({ detail: 'name: no', field: 'name' })).toEqual({ name: 'no' });
    expect(faultsOf({ detail, field: 'goal_m' })).toEqual({ form: 'no' });
    expect(faultsOf({ detail })).toEqual({ form: 'no' });
  });
});

it('has recipes inside the ranges of the fields', () => {
  for (const recipe of Object.values(RECIPES)) {
    for (const setting of SETTINGS) {
      if (setting.kind !== 'number') continue;
      expect(recipe[setting.name]).toBeGreaterThanOrEqual(setting.min);
      expect(recipe[setting.name]).toBeLessThanOrEqual(setting.max);
    }
  }
});

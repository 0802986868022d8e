import { describe, expect, it } from 'vitest';
import { RECIPES } from '../../net/forms.gen';
import {
  BLANK,
  changeWords,
  type Draft,
  nameFault,
  queryOf,
  SETTINGS,
  settingText,
  suggestedName,
  toyQuery,
  changedSettings,
  type SettingName,
} from './recipes';

const withSetting = (draft: Draft, name: SettingName, text: string): Draft => ({
  ...draft,
  settings: changedSettings(draft, name, text),
});
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
    expect(nameFault(name)).toContain('a to z');
  });
});

describe('the request', () => {
  it('has no settings that are as in the recipe', () => {
    expect(made(BLANK)).toEqual({
      map: 'posts',
      name: 'my-posts',
      seed: 1,
      recipe: 'quick',
      settings: Object.fromEntries(SETTINGS.map(({ name }) => [name, null])),
      start_from: null,
      goal_m: null,
    });
  });

  it('has the changed settings', () => {
    const draft = { ...BLANK, recipe: 'paper', start_from: 'colon' } as const;
    const query = made(
      withSetting(
        withSetting(withSetting(draft, 'discount', '0.5'), 'noisy', 'false'),
        'fusion',
        'late',
      ),
    );
    expect(query).toMatchObject({
      recipe: 'paper',
      settings: { discount: 0.5, noisy: false, fusion: 'late', updates: null },
      start_from: 'colon',
    });
    expect(changeWords(query)).toEqual(['discount 0.5', 'noisy layers off', 'fusion late']);
  });

  it('drops a change that is taken back', () => {
    const draft = withSetting(withSetting(BLANK, 'n_step', '3'), 'n_step', '1');
    expect(draft.settings).toEqual({});
    expect(settingText(draft, 'learning_rate')).toBe('0.001');
  });
});

it('asks for the toy as it is', () => {
  const { settings, ...query } = toyQuery('my-toy', 3);
  const others = { start_from: null, goal_m: null };
  expect(query).toEqual({ map: 'toy', name: 'my-toy', seed: 3, recipe: 'toy', ...others });
  expect(new Set(Object.values(settings))).toEqual(new Set([null]));
});

it('has recipes inside the ranges of the fields', () => {
  for (const recipe of RECIPES.map(({ settings }) => settings)) {
    for (const setting of SETTINGS) {
      if (setting.kind !== 'number') continue;
      expect(recipe[setting.name]).toBeGreaterThanOrEqual(setting.min);
      expect(recipe[setting.name]).toBeLessThanOrEqual(setting.max);
    }
  }
});

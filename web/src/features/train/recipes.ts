// Recipes, settings, and the request for a training from the form's fields. Pure.

import type { Catalog } from '../../lab/catalog';
import { freeName } from '../../lab/maps';
import { RECIPES, TRAINING_SETTINGS } from '../../net/forms.gen';
import type { RecipeName, TrainingQuery } from '../../net/protocol.gen';
import { numberOf } from '../../ui/fields/number';

export type SettingName = keyof typeof TRAINING_SETTINGS;

/** In the order of the form. */
export const SETTINGS = Object.values(TRAINING_SETTINGS);

/** The form, as typed. */
export interface Draft {
  /** Undefined: the map of the session. */
  readonly map: string | undefined;
  /** Undefined: a suggestion. */
  readonly name: string | undefined;
  /** Empty: random weights. */
  readonly start_from: string;
  readonly recipe: RecipeName;
  /** Those that the user has changed. */
  readonly settings: Partial<Readonly<Record<SettingName, string>>>;
  readonly seed: string;
}

export const BLANK: Draft = {
  map: undefined,
  name: undefined,
  start_from: '',
  recipe: 'quick',
  settings: {},
  seed: '1',
};

export const NAME_LENGTH = 40;
const NAME = /^[a-z0-9][a-z0-9_-]{0,39}$/;
const NAME_RULE =
  'A name has 1 to 40 characters: a to z, 0 to 9, - and _. It starts with a letter or a digit.';

/** Why a policy cannot have this name, if it cannot. */
export const nameFault = (name: string): string | undefined =>
  NAME.test(name) ? undefined : NAME_RULE;

/** A name that no other policy has. */
export function suggestedName(map: string, taken: readonly string[]): string {
  const mine = map.startsWith('my-') ? map : `my-${map}`;
  // Leaves room for a number.
  return freeName(mine.slice(0, NAME_LENGTH - 4), taken);
}

/** Names that a policy has, or will have. */
export const takenNames = (catalog: Pick<Catalog, 'policies' | 'trainings'>): string[] => [
  ...(catalog.policies() ?? []).map(({ name }) => name),
  ...(catalog.trainings() ?? []).map(({ query }) => query.name),
];

export const recipeOf = (name: RecipeName): (typeof RECIPES)[number] =>
  RECIPES.find((one) => one.name === name) ?? RECIPES[0];

/** A setting as the form shows it. */
export function settingText({ recipe, settings }: Draft, name: SettingName): string {
  return settings[name] ?? String(recipeOf(recipe).settings[name]);
}

/** The changed settings with one more; one that is as in the recipe is no change. */
export function changedSettings(draft: Draft, name: SettingName, text: string): Draft['settings'] {
  const isAsInRecipe = text === String(recipeOf(draft.recipe).settings[name]);
  const others = Object.entries(draft.settings).filter(([one]) => one !== name);
  return Object.fromEntries(isAsInRecipe ? others : [...others, [name, text]]);
}

/** The body of the request, from a draft without faults. */
export function queryOf(draft: Draft, map: string, name: string): TrainingQuery {
  const settings = SETTINGS.map(({ kind, name: setting }) => {
    const text = draft.settings[setting];
    if (text === undefined) return [setting, null];
    return [setting, { number: numberOf(text), flag: text === 'true', choice: text }[kind]];
  });
  return {
    map,
    name,
    seed: numberOf(draft.seed),
    recipe: draft.recipe,
    settings: Object.fromEntries(settings) as TrainingQuery['settings'],
    start_from: draft.start_from === '' ? null : draft.start_from,
    goal_m: null,
  };
}

/** Its training takes seconds. */
export const TOY_MAP = 'toy';

export const toyQuery = (name: string, seed: number): TrainingQuery =>
  queryOf({ ...BLANK, recipe: 'toy', seed: String(seed) }, TOY_MAP, name);

/** The settings of a training that differ from its recipe, as words. */
export function changeWords({ settings }: Pick<TrainingQuery, 'settings'>): string[] {
  return SETTINGS.flatMap((setting) => {
    const value = settings[setting.name];
    if (value === null) return [];
    const options: readonly (readonly [string, string])[] =
      setting.kind === 'choice' ? setting.options : [];
    const option = typeof value === 'boolean' ? (value ? 'on' : 'off') : String(value);
    const text = options.find(([id]) => id === value)?.[1].toLowerCase() ?? option;
    return [`${setting.label.toLowerCase()} ${text}`];
  });
}

// Recipes, settings, and the request for a training from the form's fields. Pure.

import {
  RECIPES,
  type FusionName,
  type RecipeName,
  type TrainingQuery,
} from '../../net/protocol.gen';
import { freeName } from '../../lab/maps';
import { numberFault, numberOf } from '../../ui/number';

export interface Settings {
  readonly updates: number;
  readonly learning_rate: number;
  readonly discount: number;
  readonly exploration: number;
  readonly noisy: boolean;
  readonly progress_reward: number;
  readonly step_penalty: number;
  readonly n_step: number;
  readonly fusion: FusionName;
}

export type SettingName = keyof Settings;

export const RECIPE_WORDS: readonly (readonly [RecipeName, label: string, about: string])[] = [
  ['quick', 'Quick', 'Learns one map in minutes.'],
  ['full', 'Full', 'That of the shipped policies. It takes half as long again.'],
  ['paper', 'Paper', 'Rewards, fusion and returns of the paper: slower to learn.'],
];

interface NumberSetting {
  readonly kind: 'number';
  readonly name: {
    [K in SettingName]: Settings[K] extends number ? K : never;
  }[SettingName];
  readonly label: string;
  readonly help: string;
  readonly min: number;
  readonly max: number;
  readonly step: number;
  readonly isWhole?: true;
}

interface ChoiceSetting {
  readonly kind: 'choice';
  readonly name: 'noisy' | 'fusion';
  readonly label: string;
  readonly help: string;
  readonly options: readonly (readonly [value: string, label: string])[];
}

/** In the order of the form. */
export const SETTINGS: readonly (NumberSetting | ChoiceSetting)[] = [
  {
    kind: 'number',
    name: 'updates',
    label: 'Updates',
    help: 'How often the network is corrected: more updates take longer and end better.',
    min: 1,
    max: 20_000,
    step: 500,
    isWhole: true,
  },
  {
    kind: 'number',
    name: 'learning_rate',
    label: 'Learning rate',
    help: 'How far each update moves the network: too small is slow, too large forgets.',
    min: 0,
    max: 0.1,
    step: 0.0001,
  },
  {
    kind: 'number',
    name: 'discount',
    label: 'Discount',
    help: 'How much a reward counts one step later: near 1, the goal is felt from far away.',
    min: 0,
    max: 1,
    step: 0.01,
  },
  {
    kind: 'number',
    name: 'exploration',
    label: 'Exploration',
    help: 'The share of steps in a random direction, so that the robot finds new routes.',
    min: 0,
    max: 1,
    step: 0.01,
  },
  {
    kind: 'choice',
    name: 'noisy',
    label: 'Noisy layers',
    help: 'Noise inside the network makes it try other steps where it is not sure.',
    options: [
      ['true', 'On'],
      ['false', 'Off'],
    ],
  },
  {
    kind: 'number',
    name: 'progress_reward',
    label: 'Progress reward',
    help: 'Reward for each step that shortens the path to the goal: it shows the direction early.',
    min: 0,
    max: 1,
    step: 0.05,
  },
  {
    kind: 'number',
    name: 'step_penalty',
    label: 'Step penalty',
    help: 'Subtracted at each step, so that short paths are worth more.',
    min: 0,
    max: 1,
    step: 0.05,
  },
  {
    kind: 'number',
    name: 'n_step',
    label: 'Steps of a return',
    help: 'How many real rewards are added up before the network’s own estimate takes over.',
    min: 1,
    max: 20,
    step: 1,
    isWhole: true,
  },
  {
    kind: 'choice',
    name: 'fusion',
    label: 'Fusion',
    help: 'Where the network joins image and goal: early is that of the paper, late learns faster.',
    options: [
      ['late', 'Late'],
      ['early', 'Early'],
    ],
  },
];

/** The form, as typed. */
export interface Draft {
  /** Undefined: the map of the session. */
  readonly map?: string;
  /** Undefined: a suggestion. */
  readonly name?: string;
  /** Empty: random weights. */
  readonly startFrom: string;
  readonly recipe: RecipeName;
  /** Those that the user has changed. */
  readonly settings: Partial<Readonly<Record<SettingName, string>>>;
  readonly seed: string;
}

export const BLANK: Draft = { startFrom: '', recipe: 'quick', settings: {}, seed: '1' };

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

/** A setting as the form shows it. */
export function settingText({ recipe, settings }: Draft, name: SettingName): string {
  return settings[name] ?? String(RECIPES[recipe][name]);
}

/** The draft with a setting; one that is as in the recipe is no change. */
export function withSetting(draft: Draft, name: SettingName, text: string): Draft {
  const isAsInRecipe = text === String(RECIPES[draft.recipe][name]);
  const others = Object.entries(draft.settings).filter(([one]) => one !== name);
  const settings = isAsInRecipe ? others : [...others, [name, text] as const];
  return { ...draft, settings: Object.fromEntries(settings) };
}

/** By the server's names of the fields; `form` if the fault is at no field. */
export type Faults = Readonly<Partial<Record<string, string>>>;

const WHOLE = /^\d+$/;

function settingFault(setting: NumberSetting, text: string): string | undefined {
  const { label, min, max, isWhole } = setting;
  if (numberFault(text, setting) === undefined) return undefined;
  return `${label} must be a ${isWhole ? 'whole ' : ''}number from ${min} to ${max}.`;
}

/** The body of the request, or the faults of the draft. */
export function queryOf(
  draft: Draft,
  map: string,
  name: string,
): { query: TrainingQuery } | { faults: Faults } {
  const faults: Partial<Record<string, string>> = {};
  const wrongName = nameFault(name);
  if (wrongName !== undefined) faults.name = wrongName;
  const seed = Number(draft.seed);
  if (!WHOLE.test(draft.seed) || !Number.isSafeInteger(seed)) {
    faults.seed = 'The seed must be a whole number from 0 to 9007199254740991.';
  }
  const changed: Partial<Record<SettingName, number>> = {};
  for (const setting of SETTINGS) {
    const text = draft.settings[setting.name];
    if (setting.kind !== 'number' || text === undefined) continue;
    const wrong = settingFault(setting, text);
    if (wrong === undefined) changed[setting.name] = numberOf(text);
    else faults[`settings.${setting.name}`] = wrong;
  }
  if (Object.keys(faults).length > 0) return { faults };
  const { noisy, fusion } = draft.settings;
  return {
    query: {
      map,
      name,
      seed,
      recipe: draft.recipe,
      settings: {
        updates: changed.updates ?? null,
        learning_rate: changed.learning_rate ?? null,
        discount: changed.discount ?? null,
        exploration: changed.exploration ?? null,
        noisy: noisy === undefined ? null : noisy === 'true',
        progress_reward: changed.progress_reward ?? null,
        step_penalty: changed.step_penalty ?? null,
        n_step: changed.n_step ?? null,
        fusion: (fusion as FusionName | undefined) ?? null,
      },
      start_from: draft.startFrom === '' ? null : draft.startFrom,
      goal_m: null,
    },
  };
}

const FIELDS: readonly string[] = [
  ...['map', 'name', 'seed', 'recipe', 'start_from'],
  ...SETTINGS.map(({ name }) => `settings.${name}`),
];

/** The server's refusal at the field that it names. */
export function faultsOf(refusal: { detail: string; field?: string | undefined }): Faults {
  const field = FIELDS.find((one) => one === refusal.field) ?? 'form';
  // The server's text begins with its own name of the field.
  const own = `${refusal.field ?? ''}: `;
  const { detail } = refusal;
  return { [field]: detail.startsWith(own) ? detail.slice(own.length) : detail };
}

/** The settings of a training that differ from its recipe, as words. */
export function changeWords({ settings }: Pick<TrainingQuery, 'settings'>): string[] {
  return SETTINGS.flatMap((setting) => {
    const value = settings[setting.name];
    if (value === null) return [];
    const text =
      setting.kind === 'choice'
        ? (setting.options.find(([id]) => id === String(value))?.[1].toLowerCase() ?? '')
        : String(value);
    return [`${setting.label.toLowerCase()} ${text}`];
  });
}

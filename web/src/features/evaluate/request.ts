// The request for an evaluation, from the form's fields. Pure.

import type { ControllerName, EvaluationQuery, EvaluationSummary } from '../../net/protocol.gen';
import { CONTROLLERS, type NumberName } from '../../lab/parameters';
import { counted } from '../../ui/format';
import { numberFault, numberOf } from '../../ui/number';
import { secondsAnEpisode } from './progress';
import { numberField } from './varied';

export type Field =
  'controllers' | 'rl_policy' | 'maps' | 'disturbances' | 'vary' | 'episodes' | 'seed';

/** A parameter that takes several values, as typed. */
export interface VariedDraft {
  readonly name: NumberName;
  /** In the shown unit; empty if it is not a number. */
  readonly from: string;
  readonly to: string;
  readonly count: string;
}

export interface Draft {
  readonly controllers: readonly ControllerName[];
  readonly rl_policy: string;
  /** Name of a program; empty without one. */
  readonly program: string;
  readonly maps: readonly string[];
  readonly disturbances: readonly number[];
  /** At most two. */
  readonly vary: readonly VariedDraft[];
  /** As typed; empty if it is not a number. */
  readonly episodes: string;
  readonly seed: string;
}

/** The paper's two experiments (§V-A). */
export const PAPERS: Draft = {
  controllers: ['rl'],
  rl_policy: 'auto',
  program: '',
  maps: ['colon'],
  disturbances: [0, 3],
  vary: [],
  episodes: '30',
  seed: '1',
};

export type Faults = Readonly<Partial<Record<Field | 'form', string | undefined>>>;

const WHOLE = /^\d+$/;

const isNumber = (text: string): boolean => numberFault(text) === undefined;

/** From the shown unit, without the noise of binary fractions. */
function stored(name: NumberName, text: string): number {
  return Number((numberOf(text) / numberField(name).scale).toPrecision(12));
}

/** The query, or the faults of the draft. The server checks the limits. */
export function queryOf(draft: Draft): { query: EvaluationQuery } | { faults: Faults } {
  const faults: Partial<Record<Field, string>> = {};
  if (draft.controllers.length === 0 && draft.program === '')
    faults.controllers = 'Choose at least one controller.';
  if (draft.maps.length === 0) faults.maps = 'Choose at least one map.';
  if (draft.disturbances.length === 0)
    faults.disturbances = 'Choose at least one number of disturbances.';
  const wrong = draft.vary.find(
    ({ from, to, count }) => !isNumber(from) || !isNumber(to) || !WHOLE.test(count),
  );
  if (wrong)
    faults.vary = `${numberField(wrong.name).label}: type the first value, the last one and how many.`;
  if (!WHOLE.test(draft.episodes))
    faults.episodes = 'Episodes must be a whole number from 1 to 1000.';
  const seed = Number(draft.seed);
  if (!WHOLE.test(draft.seed) || !Number.isSafeInteger(seed)) {
    faults.seed = 'The seed must be a whole number from 0 to 9007199254740991.';
  }
  if (Object.keys(faults).length > 0) return { faults };
  const { controllers, rl_policy, program, maps, disturbances } = draft;
  return {
    query: {
      controllers: program === '' ? [...controllers] : [...controllers, 'program'],
      maps: [...maps],
      disturbances: [...disturbances],
      episodes: Number(draft.episodes),
      seed,
      // Without RL there is no policy to name.
      rl_policy: controllers.includes('rl') ? rl_policy : 'auto',
      program: program === '' ? null : program,
      vary: draft.vary.map(({ name, from, to, count }) => ({
        name,
        from: stored(name, from),
        to: stored(name, to),
        count: Number(count),
      })),
    },
  };
}

const FIELDS: readonly Field[] = [
  'controllers',
  'rl_policy',
  'maps',
  'disturbances',
  'vary',
  'episodes',
  'seed',
];

/** The server's refusal at the field that it names: `maps[1]` belongs to the maps, `program` to the controllers. */
export function faultsOf(refusal: { detail: string; field?: string | undefined }): Faults {
  const named = refusal.field?.replace(/\[.*$/, '');
  const name = named === 'program' ? 'controllers' : named;
  const field = FIELDS.find((one) => one === name) ?? 'form';
  return { [field]: refusal.detail };
}

/** Adds or removes `item`, in the order of `all`. */
export function toggled<T>(all: readonly T[], chosen: readonly T[], item: T, on: boolean): T[] {
  return all.filter((one) => (one === item ? on : chosen.includes(one)));
}

/** Controllers and the program after a choice among both: another program takes the place of the last one. */
export function chooseControllers(
  chosen: readonly string[],
  last: string,
): Pick<Draft, 'controllers' | 'program'> {
  const programs = chosen.filter((name) => !CONTROLLERS.some((own) => own === name));
  const added = programs.find((name) => name !== last);
  return {
    controllers: CONTROLLERS.filter((name) => chosen.includes(name)),
    program: added ?? programs[0] ?? '',
  };
}

/** Number of combinations of the varied values. */
function combinations({ vary }: EvaluationQuery): number {
  return vary.reduce((product, { count }) => product * count, 1);
}

/** `4 cells, 120 episodes`. */
export function sizeWords(query: EvaluationQuery): string {
  const cells =
    query.controllers.length * query.maps.length * query.disturbances.length * combinations(query);
  return `${counted(cells, 'cell')}, ${counted(cells * query.episodes, 'episode')}`;
}

/** Estimated duration; undefined if no similar cell was measured. */
export function estimate_s(
  query: EvaluationQuery,
  measured: readonly EvaluationSummary[],
): number | undefined {
  let sum_s = 0;
  for (const map of query.maps) {
    for (const disturbances of query.disturbances) {
      for (const controller of query.controllers) {
        const episode_s = secondsAnEpisode(
          { controller, map, disturbances, program: query.program, varied: [] },
          measured,
        );
        if (episode_s === undefined) return undefined;
        sum_s += episode_s * query.episodes * combinations(query);
      }
    }
  }
  return sum_s;
}

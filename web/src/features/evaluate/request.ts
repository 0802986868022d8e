// The request for an evaluation, from the form's fields. Pure.

import type { Cell, ControllerName, EvaluationQuery } from '../../net/protocol.gen';
import { CONTROLLERS, type NumberName } from '../../lab/parameters';
import { counted } from '../../ui/format';
import { numberOf } from '../../ui/fields/number';
import { numberField } from './varied';

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

/** From the shown unit, without the noise of binary fractions. */
function stored(name: NumberName, text: string): number {
  return Number((numberOf(text) / numberField(name).scale).toPrecision(12));
}

/** The body of the request, from a draft without faults. */
export function queryOf(draft: Draft): EvaluationQuery {
  const { controllers, rl_policy, program, maps, disturbances } = draft;
  return {
    controllers: program === '' ? [...controllers] : [...controllers, 'program'],
    maps: [...maps],
    disturbances: [...disturbances],
    episodes: numberOf(draft.episodes),
    seed: numberOf(draft.seed),
    // Without RL there is no policy to name.
    rl_policy: controllers.includes('rl') ? rl_policy : 'auto',
    program: program === '' ? null : program,
    vary: draft.vary.map(({ name, from, to, count }) => ({
      name,
      from: stored(name, from),
      to: stored(name, to),
      count: numberOf(count),
    })),
  };
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

/** What is counted together: each controller, map and number of disturbances. */
const cellsOf = ({ controllers, maps, disturbances, program }: EvaluationQuery): Cell[] =>
  maps.flatMap((map) =>
    disturbances.flatMap((count) =>
      controllers.map((controller) => ({
        controller,
        map,
        disturbances: count,
        program,
        varied: [],
      })),
    ),
  );

/** Number of combinations of the varied values. */
function combinations({ vary }: EvaluationQuery): number {
  return vary.reduce((product, { count }) => product * count, 1);
}

/** `4 cells, 120 episodes`; undefined if there are none. */
export function sizeWords(query: EvaluationQuery): string | undefined {
  const cells = cellsOf(query).length * combinations(query);
  // Not a number either, as long as one is being typed.
  if (!(cells * query.episodes > 0)) return undefined;
  return `${counted(cells, 'cell')}, ${counted(cells * query.episodes, 'episode')}`;
}

/** Estimated duration; NaN if a pace is not known. */
export function estimate_s(query: EvaluationQuery, pace: (work: string) => number): number {
  return cellsOf(query)
    .map(
      ({ controller }) => pace(`evaluation_${controller}`) * query.episodes * combinations(query),
    )
    .reduce((sum_s, cell_s) => sum_s + cell_s, 0);
}

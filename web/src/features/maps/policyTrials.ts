// Whether a shipped policy delivers on a new map: a few trials of each in the background, as evaluations.

import { createEffect, createMemo, createSignal } from 'solid-js';
import type { Catalog } from '../../lab/catalog';
import { startPath } from '../../lab/jobs';
import type { EvaluationQuery, EvaluationSummary } from '../../net/protocol.gen';
import { reasonText } from '../../net/problem';
import { post } from '../../net/requests';

/** Of each policy, with random starts and goals. */
export const TRIALS = 5;
const SEED = 1;

type Outcome =
  | { readonly kind: 'trying'; readonly done: number }
  /** All trials have run. */
  | { readonly kind: 'tried'; readonly delivered: number }
  | { readonly kind: 'failed'; readonly why: string };

/** One policy on the map. */
export interface PolicyTrial {
  readonly policy: string;
  readonly outcome: Outcome;
}

interface Started {
  readonly policy: string;
  /** Of its evaluation. */
  readonly id: string | undefined;
  /** Why it could not be started. */
  readonly refusal?: string;
}

function outcomeOf({ id, refusal }: Started, all: readonly EvaluationSummary[]): Outcome {
  if (refusal !== undefined) return { kind: 'failed', why: refusal };
  const now = all.find((one) => one.id === id);
  const [done, delivered] = [now?.cells[0]?.done ?? 0, now?.cells[0]?.delivered ?? 0];
  if (now?.stage === 'failed') return { kind: 'failed', why: now.message ?? 'it failed' };
  if (now?.stage === 'cancelled') return { kind: 'failed', why: 'it was cancelled' };
  return now?.stage === 'done' ? { kind: 'tried', delivered } : { kind: 'trying', done };
}

export const solves = ({ outcome }: PolicyTrial): boolean =>
  outcome.kind === 'tried' && outcome.delivered === TRIALS;

/** `session` starts them. */
export function createPolicyTrials(catalog: Catalog, session: string) {
  const [started, setStarted] = createSignal<readonly Started[]>([]);
  /** One that was trained on a single map knows no other. */
  const offered = (): readonly string[] =>
    (catalog.policies() ?? [])
      .filter(({ is_shipped, maps }) => is_shipped && maps.length > 1)
      .map(({ reference }) => reference);
  const all = createMemo((): readonly PolicyTrial[] =>
    started().map((one) => ({
      policy: one.policy,
      outcome: outcomeOf(one, catalog.evaluations() ?? []),
    })),
  );
  let map: string | undefined;
  const startOne = async (policy: string, before: readonly Started[]): Promise<void> => {
    if (map === undefined) return;
    const query: EvaluationQuery = {
      controllers: ['rl'],
      maps: [map],
      disturbances: [0],
      episodes: TRIALS,
      seed: SEED,
      rl_policy: policy,
      program: null,
      vary: [],
    };
    const asked: readonly Started[] = [...before, { policy, id: undefined }];
    setStarted(asked);
    try {
      const path = startPath('/api/evaluations', session);
      const { id } = await post<EvaluationSummary>(path, JSON.stringify(query));
      if (started() === asked) setStarted([...before, { policy, id }]);
    } catch (reason) {
      const refusal = reasonText(reason);
      if (started() === asked) setStarted([...before, { policy, id: undefined, refusal }]);
    }
  };
  /** Forgets them. What still runs is over in some seconds. */
  const stop = (): void => {
    map = undefined;
    setStarted([]);
  };
  // The next one is tried only if the one before does not solve the map.
  createEffect(() => {
    const [last, next] = [all().at(-1), offered()[started().length]];
    if (last && last.outcome.kind !== 'trying' && !solves(last) && next !== undefined)
      void startOne(next, started());
  });
  return {
    /** Tries the policies on a map, one after the other until one solves it. */
    start: (on: string): void => {
      stop();
      map = on;
      const [first] = offered();
      if (first !== undefined) void startOne(first, []);
    },
    stop,
    all,
    /** Whether all were tried and none solves the map. */
    isUnsolved: (): boolean =>
      all().length === offered().length &&
      all().some(({ outcome }) => outcome.kind === 'tried') &&
      all().every((one) => one.outcome.kind !== 'trying' && !solves(one)),
  };
}

export type PolicyTrials = ReturnType<typeof createPolicyTrials>;

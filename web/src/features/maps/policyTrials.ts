// Whether a shipped policy delivers on a new map: a few trials of each in the background, as evaluations.

import { createSignal } from 'solid-js';
import type { Catalog } from '../../lab/catalog';
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

export function createPolicyTrials(catalog: Catalog) {
  const [started, setStarted] = createSignal<readonly Started[]>([]);
  /** One that was trained on a single map knows no other. */
  const offered = (): readonly string[] =>
    (catalog.policies() ?? [])
      .filter(({ is_shipped, maps }) => is_shipped && maps.length > 1)
      .map(({ reference }) => reference);
  const startOne = async (map: string, policy: string): Promise<Started> => {
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
    try {
      const { id } = await post<EvaluationSummary>('/api/evaluations', JSON.stringify(query));
      return { policy, id };
    } catch (reason) {
      return { policy, id: undefined, refusal: reasonText(reason) };
    }
  };
  return {
    /** Tries the policies on a map, one after the other, in place of those on another map. */
    start: async (map: string): Promise<void> => {
      setStarted(offered().map((policy) => ({ policy, id: undefined })));
      const all = started();
      for (const { policy } of all) {
        const one = await startOne(map, policy);
        setStarted((now) => now.map((other) => (other.policy === policy ? one : other)));
      }
    },
    all: (): readonly PolicyTrial[] =>
      started().map((one) => ({
        policy: one.policy,
        outcome: outcomeOf(one, catalog.evaluations() ?? []),
      })),
  };
}

export type PolicyTrials = ReturnType<typeof createPolicyTrials>;

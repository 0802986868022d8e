// The server's trainings and policies: lists, polled while the view is open, and what can be done with them.

import type { Accessor } from 'solid-js';
import { createPoll, type Poll } from '../../net/poll';
import type {
  Policies,
  PolicySummary,
  TrainingQuery,
  Trainings,
  TrainingSummary,
} from '../../net/protocol.gen';
import { patch, post, remove } from '../../net/requests';
import { isActive } from '../../lab/trainingStage';

const BUSY_MS = 1000;
/** Another operator may start one. */
const IDLE_MS = 3000;
const POLICIES_MS = 5000;

const TRAININGS = '/api/trainings';
const POLICIES = '/api/policies';

export const trainingPath = (id: string): string => `${TRAININGS}/${encodeURIComponent(id)}`;

const policyPath = (name: string): string => `${POLICIES}/${encodeURIComponent(name)}`;

export const policyFile = (name: string): string => `${policyPath(name)}.safetensors`;

export interface TrainingList {
  /** In the order of the requests; undefined before the first answer. */
  readonly all: Accessor<readonly TrainingSummary[] | undefined>;
  /** Why the list is out of date, if it is. */
  readonly trouble: Accessor<string | undefined>;
  /** Returns the id. Throws a refusal, as the others do. */
  start(query: TrainingQuery): Promise<string>;
  pause(id: string): Promise<void>;
  resume(id: string): Promise<void>;
  /** Cancels one that has not ended, and removes one that has. */
  discard(id: string): Promise<void>;
}

export function createTrainingList(): TrainingList {
  const poll: Poll<Trainings> = createPoll(TRAININGS, (newest) =>
    newest?.trainings.some(isActive) ? BUSY_MS : IDLE_MS,
  );
  const then = async (change: Promise<unknown>): Promise<void> => {
    await change;
    await poll.refresh();
  };
  return {
    all: () => poll.data()?.trainings,
    trouble: poll.error,
    start: async (query) => {
      const { id } = await post<TrainingSummary>(TRAININGS, JSON.stringify(query));
      await poll.refresh();
      return id;
    },
    pause: (id) => then(post(`${trainingPath(id)}/pause`)),
    resume: (id) => then(post(`${trainingPath(id)}/resume`)),
    discard: (id) => then(remove(trainingPath(id))),
  };
}

export interface PolicyList {
  /** The shipped ones first; undefined before the first answer. */
  readonly all: Accessor<readonly PolicySummary[] | undefined>;
  readonly trouble: Accessor<string | undefined>;
  readonly refresh: () => Promise<void>;
  /** Throws a refusal, as the others do. */
  upload(name: string, file: File): Promise<void>;
  rename(name: string, next: string): Promise<void>;
  discard(name: string): Promise<void>;
}

export function createPolicyList(): PolicyList {
  const poll: Poll<Policies> = createPoll(POLICIES, () => POLICIES_MS);
  const then = async (change: Promise<unknown>): Promise<void> => {
    await change;
    await poll.refresh();
  };
  return {
    all: () => poll.data()?.policies,
    trouble: poll.error,
    refresh: poll.refresh,
    upload: (name, file) => then(post(policyPath(name), file, 'application/octet-stream')),
    rename: (name, next) => then(patch(policyPath(name), JSON.stringify({ name: next }))),
    discard: (name) => then(remove(policyPath(name))),
  };
}

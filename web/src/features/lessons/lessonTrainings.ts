// The trainings of the lessons.

import { createSignal } from 'solid-js';
import { isActive } from '../../lab/trainingStage';
import type { Catalog } from '../../lab/catalog';
import type { TrainingSummary } from '../../net/protocol.gen';
import { post, remove } from '../../net/requests';
import { createAttempt } from '../../ui/attempt';
import type { TrainingRun } from './lesson';

const MAP = 'u-turn';
const SEED = 1;

export function createLessonTrainings(catalog: Catalog) {
  const { attempt, refusal, forget } = createAttempt();
  const [ids, setIds] = createSignal<ReadonlyMap<TrainingRun, string>>(new Map());
  const listed = (): readonly TrainingSummary[] => catalog.trainings() ?? [];
  const start = async (run: TrainingRun): Promise<void> => {
    const { policy, settings, startFrom } = run;
    const active = listed().find((one) => one.query.name === policy && isActive(one));
    if (!active && catalog.policies()?.some(({ name }) => name === policy))
      await remove(`/api/policies/${policy}`);
    const query = { map: MAP, name: policy, seed: SEED, settings, start_from: startFrom };
    const { id } = active ?? (await post<TrainingSummary>('/api/trainings', JSON.stringify(query)));
    setIds(new Map(ids()).set(run, id));
  };
  return {
    /** Undefined before it is started in the open lesson. */
    summary: (run: TrainingRun): TrainingSummary | undefined =>
      listed().find(({ id }) => id === ids().get(run)),
    /** Why the newest request was refused, if it was. */
    refusal,
    /** Trains, in place of the policy of an earlier time; follows a training that is still active. */
    start: (run: TrainingRun) => attempt(start(run)),
    /** Another lesson is opened. */
    forget: (): void => {
      setIds(new Map());
      forget();
    },
  };
}

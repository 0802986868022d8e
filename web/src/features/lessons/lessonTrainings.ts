// The trainings of the open lesson.

import { createMemo, createSignal, type Accessor } from 'solid-js';
import { isActive } from '../../lab/trainingStage';
import type { Catalog } from '../../lab/catalog';
import type { Examination, TrainingSummary } from '../../net/protocol.gen';
import { post, remove } from '../../net/requests';
import { isTrainingLesson, type Lesson, type TrainingRun } from './lesson';

const MAP = 'u-turn';
const SEED = 1;

export interface LessonTrainings {
  /** One per run that was started. */
  readonly summaries: Accessor<readonly (TrainingSummary | undefined)[]>;
  /** The last examinations, when all trainings are done. */
  readonly examinations: Accessor<readonly Examination[] | undefined>;
  /** Why the newest request was refused, if it was. */
  readonly refusal: Accessor<string | undefined>;
  /** Trains, in place of the policy of an earlier time; follows a training that is still active. */
  start(index: number, run: TrainingRun): Promise<void>;
}

export function createLessonTrainings(
  catalog: Catalog,
  lesson: Accessor<Lesson | undefined>,
): LessonTrainings {
  const [refusal, setRefusal] = createSignal<string>();
  /** Ids by run; empty again in another lesson. */
  const ids = createMemo(() => {
    lesson();
    return createSignal<readonly (string | undefined)[]>([]);
  });
  const listed = (): readonly TrainingSummary[] => catalog.trainings() ?? [];
  const summaries = createMemo(() => {
    const [known] = ids();
    return known().map((id) => listed().find((one) => one.id === id));
  });
  return {
    summaries,
    refusal,
    examinations: createMemo(() => {
      const now = lesson();
      if (!now || !isTrainingLesson(now)) return undefined;
      const done = summaries().flatMap((one) =>
        one?.stage === 'done' && one.examined ? [one.examined] : [],
      );
      return done.length === now.trainings.length ? done : undefined;
    }),
    async start(index, { policy, settings, startFrom }) {
      const [known, setKnown] = ids();
      setRefusal(undefined);
      try {
        const active = listed().find((one) => one.query.name === policy && isActive(one));
        if (!active && catalog.policies()?.some(({ name }) => name === policy))
          await remove(`/api/policies/${policy}`);
        const query = { map: MAP, name: policy, seed: SEED, settings, start_from: startFrom };
        const { id } =
          active ?? (await post<TrainingSummary>('/api/trainings', JSON.stringify(query)));
        const next = [...known()];
        next[index] = id;
        setKnown(next);
      } catch (reason) {
        setRefusal(reason instanceof Error ? reason.message : String(reason));
      }
    },
  };
}

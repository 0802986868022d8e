// A step of a lesson that trains a policy.

import { For, Show, type JSX } from 'solid-js';
import type { Session, Trial } from '../../lab/slices';
import { isActive, stageSentence, updateWords } from '../../lab/trainingStage';
import type { TrainingSummary } from '../../net/protocol.gen';
import type { TrainingRun } from './lesson';
import { NotOperator } from './NotOperator';
import type { Lessons } from './store';

export function TrainingStep(props: {
  lab: Session & Trial;
  store: Lessons;
  run: TrainingRun;
}): JSX.Element {
  const { lab, store } = props;
  const { trainings } = store;
  const summary = (): TrainingSummary | undefined => trainings.summaries()[store.step() - 1];
  const isBusy = (): boolean => {
    const now = summary();
    return now !== undefined && isActive(now);
  };
  return (
    <>
      <p class="lesson-run">{props.run.title}</p>
      <For each={props.run.words}>{(words) => <p>{words}</p>}</For>
      <div class="lesson-buttons">
        <button
          type="button"
          class="small"
          classList={{ primary: summary()?.stage !== 'done' }}
          aria-label={`Train ${props.run.policy}`}
          disabled={!lab.canOperate() || isBusy()}
          onClick={() => void trainings.start(store.step() - 1, props.run)}
        >
          {summary() && !isBusy() ? 'Train again' : 'Train'}
        </button>
      </div>
      <NotOperator lab={lab} to="train a policy" />
      <div role="alert">
        <Show when={trainings.refusal()}>{(text) => <p class="refusal">{text()}</p>}</Show>
      </div>
      <Show when={summary()}>
        {(now) => (
          <div class="lesson-training">
            <progress
              max={Math.max(1, now().updates_total)}
              value={now().updates}
              data-stage={now().stage}
              aria-label={`Progress of ${props.run.policy}`}
              aria-valuetext={updateWords(now())}
            />
            <p class="number" role="status">
              {stageSentence(now(), [])}
            </p>
          </div>
        )}
      </Show>
    </>
  );
}

// A step of a lesson: an experiment or a training, and what is to be seen in it.

import { For, Show, type JSX } from 'solid-js';
import { CommandButton } from '../../lab/CommandButton';
import type { Session, Trial } from '../../lab/slices';
import { isActive, stageSentence, updateWords } from '../../lab/trainingStage';
import type { TrainingSummary } from '../../net/protocol.gen';
import { isTraining, type Run, type Task, tasksOf, type TrainingRun } from './lesson';
import type { Lessons } from './store';
import { SmallButton } from '../../ui/SmallButton';

interface Props<R> {
  readonly lab: Session & Trial;
  readonly store: Lessons;
  readonly run: R;
}

/** The instructions, and why the buttons are disabled. */
function Instructions(
  props: Props<Run | TrainingRun> & { to: string; buttons: JSX.Element },
): JSX.Element {
  const { lab } = props;
  return (
    <>
      <Show when={props.run.title}>{(title) => <p class="lesson-run">{title()}</p>}</Show>
      <For each={props.run.words}>{(words) => <p>{words}</p>}</For>
      <div class="lesson-buttons">{props.buttons}</div>
      <Show when={!lab.canOperate()}>
        <p class="lesson-note">
          {lab.connection().kind === 'live'
            ? `You are watching: take control at the top of the page to ${props.to}.`
            : `No connection to the server: you cannot ${props.to} now.`}
        </p>
      </Show>
    </>
  );
}

function ExperimentStep(props: Props<Run>): JSX.Element {
  const { lab, store, run } = props;
  const isFollowed = (): boolean => store.track() !== undefined && !store.isElsewhere();
  const tasks = tasksOf(run);
  const isDone = (task: Task): boolean => {
    const track = store.track();
    return track !== undefined && task.done(track);
  };
  return (
    <>
      <Instructions
        {...props}
        to="set up the experiment"
        buttons={
          <>
            <SmallButton
              classList={{ primary: !isFollowed() }}
              disabled={!lab.canOperate()}
              onClick={() => void store.setUp(run)}
            >
              {store.track() ? 'Set it up again' : 'Set it up'}
            </SmallButton>
            <For each={run.actions}>
              {(action) => (
                <CommandButton
                  lab={lab}
                  at="workspace"
                  class="small"
                  disabled={!isFollowed()}
                  command={() => {
                    const scene = lab.scene();
                    return scene && action.message(scene);
                  }}
                >
                  {action.label}
                </CommandButton>
              )}
            </For>
          </>
        }
      />
      <Show when={store.isElsewhere()}>
        <p class="lesson-note">
          The page shows another experiment now. Set this one up again to continue.
        </p>
      </Show>
      <ul class="lesson-tasks">
        <For each={tasks}>
          {(task) => (
            <li classList={{ done: isDone(task) }}>
              <span class="task-mark" aria-hidden="true">
                {isDone(task) ? '✓' : ''}
              </span>
              <span>
                {task.text}
                <Show when={isDone(task)}>
                  <span class="visually-hidden"> (done)</span>
                </Show>
              </span>
            </li>
          )}
        </For>
      </ul>
      <p class="lesson-count number" role="status">
        {tasks.filter(isDone).length} of {tasks.length} done
      </p>
    </>
  );
}

function TrainingStep(props: Props<TrainingRun>): JSX.Element {
  const { lab, store, run } = props;
  const { trainings } = store;
  const summary = (): TrainingSummary | undefined => trainings.summary(run);
  const isBusy = (): boolean => {
    const now = summary();
    return now !== undefined && isActive(now);
  };
  return (
    <>
      <Instructions
        {...props}
        to="train a policy"
        buttons={
          <SmallButton
            classList={{ primary: summary()?.stage !== 'done' }}
            aria-label={`Train ${run.policy}`}
            disabled={!lab.canOperate() || isBusy()}
            onClick={() => void trainings.start(run)}
          >
            {summary() && !isBusy() ? 'Train again' : 'Train'}
          </SmallButton>
        }
      />
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
              aria-label={`Progress of ${run.policy}`}
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

export function RunStep(props: Props<Run | TrainingRun>): JSX.Element {
  const { lab, store, run } = props;
  return isTraining(run) ? (
    <TrainingStep lab={lab} store={store} run={run} />
  ) : (
    <ExperimentStep lab={lab} store={store} run={run} />
  );
}

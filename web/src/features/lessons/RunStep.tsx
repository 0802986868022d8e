// A step of a lesson: an experiment or a training, and what is to be seen in it.

import { Check, Lightbulb } from 'lucide';
import { For, Show, type JSX } from 'solid-js';
import { CommandButton } from '../../lab/CommandButton';
import type { Events, Session, Trial } from '../../lab/slices';
import { trackedWords } from '../../lab/tracked';
import { jobOf } from '../../lab/jobs';
import { isActive, stageSentence, updateWords } from '../../lab/trainingStage';
import type { TrainingSummary } from '../../net/protocol.gen';
import { fixed } from '../../ui/format';
import { Fact } from '../../ui/Fact';
import { Icon } from '../../ui/Icon';
import { isTraining, type Run, type TrainingRun } from './lesson';
import { Named } from './Named';
import type { Lessons } from './store';

interface Props<R> {
  readonly lab: Session & Trial & Events;
  readonly store: Lessons;
  readonly run: R;
  readonly prediction: string | undefined;
  /** The foot of the panel, with what is given at its left. */
  readonly foot: (left: JSX.Element) => JSX.Element;
}

/** What the instructions ask to look at. */
function Readings(props: { lab: Trial & Events }): JSX.Element {
  return (
    <Show when={props.lab.state()}>
      {(state) => (
        <>
          <dl class="facts">
            <Fact name="Distance e, tracked" value={trackedWords(props.lab)} />
            <Fact name="Lift / weight" value={fixed(state().lift_ratio, 2)} />
          </dl>
          <p class="hint">At lift / weight 1, the magnet lifts the bead.</p>
        </>
      )}
    </Show>
  );
}

/** The instructions, and why the buttons are disabled. */
function Instructions(props: Props<Run | TrainingRun> & { to: string }): JSX.Element {
  const { lab } = props;
  return (
    <>
      <Show when={props.run.title}>{(title) => <h3>{title()}</h3>}</Show>
      <For each={props.run.words}>
        {(words) => (
          <p>
            <Named words={words} />
          </p>
        )}
      </For>
      <Show when={!isTraining(props.run)}>
        <Readings lab={lab} />
      </Show>
      <Show when={!lab.canOperate()}>
        <p class="hint">
          {lab.connection().kind === 'live'
            ? `You are watching: take control below to ${props.to}.`
            : `No connection to the server: you cannot ${props.to} now.`}
        </p>
      </Show>
    </>
  );
}

function Prediction(props: { words: string | undefined }): JSX.Element {
  return (
    <Show when={props.words}>
      {(words) => (
        <p class="lesson-note">
          <Icon of={Lightbulb} />
          <span>
            You predicted: <strong>{words()}</strong>
          </span>
        </p>
      )}
    </Show>
  );
}

function ExperimentStep(props: Props<Run>): JSX.Element {
  const { lab, store, run } = props;
  const { isFollowed, isTaskDone: isDone } = store;
  return (
    <>
      <Instructions {...props} to="set up the experiment" />
      <Show when={run.actions}>
        <div class="buttons">
          <For each={run.actions}>
            {(action) => (
              <CommandButton
                lab={lab}
                at="workspace"
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
        </div>
      </Show>
      <Show when={store.isElsewhere()}>
        <p class="hint">
          The page shows another experiment now. Set this one up again to continue.
        </p>
      </Show>
      <Show when={store.isGoalMoved()}>
        <p class="hint">
          The goal is at another place now, and only a delivery to the goal of this experiment
          counts. Set it up again to continue.
        </p>
      </Show>
      <ul class="lesson-tasks plain">
        <For each={store.tasks()}>
          {(task) => (
            <li classList={{ done: isDone(task), next: store.nextTask() === task }}>
              <span class="task-mark" aria-hidden="true">
                <Show when={isDone(task)}>
                  <Icon of={Check} />
                </Show>
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
      <Prediction words={props.prediction} />
      {props.foot(
        <>
          <button
            type="button"
            classList={{ primary: !isFollowed() && !store.mayGoOn() }}
            disabled={!lab.canOperate()}
            onClick={() => void store.setUp(run)}
          >
            {store.track() ? 'Set it up again' : 'Set it up'}
          </button>
          <span class="number" role="status">
            {store.tasksDone()} of {store.tasks().length} done
          </span>
        </>,
      )}
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
      <Instructions {...props} to="train a policy" />
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
              {stageSentence(now(), jobOf(lab.catalog, now().id))}
            </p>
          </div>
        )}
      </Show>
      <Prediction words={props.prediction} />
      {props.foot(
        <button
          type="button"
          classList={{ primary: summary()?.stage !== 'done' && !store.mayGoOn() }}
          aria-label={`Train ${run.policy}`}
          disabled={!lab.canOperate() || isBusy()}
          onClick={() => void trainings.start(run)}
        >
          {summary() && !isBusy() ? 'Train again' : 'Train'}
        </button>,
      )}
    </>
  );
}

export function RunStep(props: Props<Run | TrainingRun>): JSX.Element {
  const { run } = props;
  return isTraining(run) ? (
    <TrainingStep {...props} run={run} />
  ) : (
    <ExperimentStep {...props} run={run} />
  );
}

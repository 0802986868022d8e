// One lesson, one step at a time: predict, run, explain.

import { For, Match, Show, Switch, createEffect, on, type JSX } from 'solid-js';
import { CommandButton } from '../../lab/CommandButton';
import { type Fact, isTrainingLesson, type Lesson, runCount, type Run } from './lesson';
import type { Lessons } from './store';
import { NotOperator } from './NotOperator';
import { TrainingStep } from './TrainingStep';
import type { Session, Trial } from '../../lab/slices';
import '../../ui/Fact.css';

interface Props {
  readonly lab: Session & Trial;
  readonly store: Lessons;
  readonly lesson: Lesson;
}

function stepNames(lesson: Lesson): readonly string[] {
  const count = runCount(lesson);
  const named =
    count === 1 ? ['Run'] : Array.from({ length: count }, (_, index) => `Run ${index + 1}`);
  return ['Predict', ...named, 'Explain'];
}

function Predict(props: Props): JSX.Element {
  const { store, lesson } = props;
  return (
    <fieldset class="lesson-choices" role="radiogroup" aria-labelledby="lesson-question">
      <p id="lesson-question">{lesson.question}</p>
      <For each={lesson.choices}>
        {({ id, text }) => (
          <label>
            <input
              type="radio"
              name={`lesson-${lesson.id}`}
              value={id}
              checked={store.progress().choices[lesson.id] === id}
              onChange={() => {
                store.choose(id);
              }}
            />
            <span>{text}</span>
          </label>
        )}
      </For>
    </fieldset>
  );
}

function RunStep(props: Props & { run: Run }): JSX.Element {
  const { lab, store } = props;
  const doneCount = (): number => {
    const track = store.track();
    return track ? props.run.tasks.filter((task) => task.done(track)).length : 0;
  };
  const isFollowed = (): boolean => store.track() !== undefined && !store.isElsewhere();
  return (
    <>
      <Show when={props.run.title}>{(title) => <p class="lesson-run">{title()}</p>}</Show>
      <For each={props.run.words}>{(words) => <p>{words}</p>}</For>
      <div class="lesson-buttons">
        <button
          type="button"
          class="small"
          classList={{ primary: !isFollowed() }}
          disabled={!lab.canOperate()}
          onClick={() => {
            void store.setUp();
          }}
        >
          {store.track() ? 'Set it up again' : 'Set it up'}
        </button>
        <For each={props.run.actions}>
          {(action) => (
            <CommandButton
              lab={lab}
              at="workspace"
              class="small"
              disabled={!isFollowed()}
              command={() => {
                const [scene, state] = [lab.scene(), lab.state()];
                return scene && state && action.message(scene, state);
              }}
            >
              {action.label}
            </CommandButton>
          )}
        </For>
      </div>
      <NotOperator lab={lab} to="set up the experiment" />
      <Show when={store.isElsewhere()}>
        <p class="lesson-note">
          The page shows another experiment now. Set this one up again to continue.
        </p>
      </Show>
      <ul class="lesson-tasks">
        <For each={props.run.tasks}>
          {(task) => {
            const isDone = (): boolean => {
              const track = store.track();
              return track !== undefined && task.done(track);
            };
            return (
              <li classList={{ done: isDone() }}>
                <span class="task-mark" aria-hidden="true">
                  {isDone() ? '✓' : ''}
                </span>
                <span>
                  {task.text}
                  <Show when={isDone()}>
                    <span class="visually-hidden"> (done)</span>
                  </Show>
                </span>
              </li>
            );
          }}
        </For>
      </ul>
      <p class="lesson-count number" role="status">
        {doneCount()} of {props.run.tasks.length} done
      </p>
    </>
  );
}

function Explain(props: Props): JSX.Element {
  const { store, lesson } = props;
  const text = (id: string | undefined): string | undefined =>
    lesson.choices.find((choice) => choice.id === id)?.text;
  /** Outcome and facts, if all runs were done since the lesson was opened. */
  const result = (): { outcome: string; facts: readonly Fact[] } | undefined => {
    if (isTrainingLesson(lesson)) {
      const measured = store.trainings.examinations();
      return measured && { outcome: lesson.outcome(measured), facts: lesson.facts(measured) };
    }
    const measured = store.tracks().filter((track) => track !== undefined);
    if (measured.length !== lesson.runs.length) return undefined;
    return { outcome: lesson.outcome(measured), facts: lesson.facts(measured) };
  };
  const chosen = (): string | undefined => store.progress().choices[lesson.id];
  return (
    <Show
      when={result()}
      fallback={
        <p class="lesson-note">You have done this lesson. Run it again to see your numbers here.</p>
      }
    >
      {(measured) => (
        <>
          <dl class="lesson-verdict" data-right={measured().outcome === chosen()}>
            <Show when={measured().outcome !== chosen()}>
              <div>
                <dt>Your prediction</dt>
                <dd>{text(chosen()) ?? 'no prediction'}</dd>
              </div>
            </Show>
            <div>
              <dt>{measured().outcome === chosen() ? 'You were right' : 'What happened'}</dt>
              <dd data-testid="lesson-outcome">{text(measured().outcome)}</dd>
            </div>
          </dl>
          <dl class="facts lesson-facts" aria-label="Measured in your run">
            <For each={measured().facts}>
              {([name, value]) => (
                <div>
                  <dt>{name}</dt>
                  <dd class="number">{value}</dd>
                </div>
              )}
            </For>
          </dl>
        </>
      )}
    </Show>
  );
}

export function LessonView(props: Props): JSX.Element {
  const { lab, store, lesson } = props;
  let heading!: HTMLHeadingElement;
  let body!: HTMLDivElement;
  const names = stepNames(lesson);
  const last = names.length - 1;
  createEffect(
    on(store.step, () => {
      body.scrollTop = 0;
      heading.focus({ preventScroll: true });
    }),
  );
  return (
    <>
      <header class="lesson-head">
        <button
          type="button"
          class="bare"
          aria-label="All lessons"
          title="All lessons"
          onClick={() => {
            store.close();
          }}
        >
          ‹
        </button>
        <h3>{lesson.title}</h3>
      </header>
      <ol class="lesson-steps" aria-label="Steps">
        <For each={names}>
          {(name, index) => (
            <li aria-current={store.step() === index() ? 'step' : undefined}>{name}</li>
          )}
        </For>
      </ol>
      <div ref={body} class="lesson-body">
        <h4 ref={heading} class="visually-hidden" tabindex="-1">
          {names[store.step()]}
        </h4>
        <Switch>
          <Match when={store.step() === 0}>
            <Predict lab={lab} store={store} lesson={lesson} />
          </Match>
          <Match when={store.run()} keyed>
            {(run) => <RunStep lab={lab} store={store} lesson={lesson} run={run} />}
          </Match>
          <Match when={store.training()} keyed>
            {(run) => <TrainingStep lab={lab} store={store} run={run} />}
          </Match>
          <Match when={store.step() === last}>
            <Explain lab={lab} store={store} lesson={lesson} />
            <For each={lesson.why}>{(words) => <p>{words}</p>}</For>
            <p class="lesson-paper">Paper: {lesson.paper}</p>
          </Match>
        </Switch>
      </div>
      <footer class="lesson-foot">
        <button
          type="button"
          class="small"
          disabled={store.step() === 0}
          onClick={() => {
            store.go(store.step() - 1);
          }}
        >
          Back
        </button>
        <Show
          when={store.step() < last}
          fallback={
            <button
              type="button"
              class="small primary"
              onClick={() => {
                store.close();
              }}
            >
              Finish
            </button>
          }
        >
          <button
            type="button"
            class="small"
            classList={{ primary: store.mayGoOn() }}
            disabled={!store.mayGoOn()}
            onClick={() => {
              store.go(store.step() + 1);
            }}
          >
            Next
          </button>
        </Show>
      </footer>
    </>
  );
}

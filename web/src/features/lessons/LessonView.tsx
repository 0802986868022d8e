// One lesson, one step at a time: predict, run, explain.

import { ArrowLeft, CircleCheck, CircleX } from 'lucide';
import { For, Match, Show, Switch, createEffect, on, type JSX } from 'solid-js';
import type { Events, Session, Trial } from '../../lab/slices';
import { Fact } from '../../ui/Fact';
import { Icon } from '../../ui/Icon';
import type { Lesson } from './lesson';
import { LESSONS } from './lessons';
import { Named } from './Named';
import { RunStep } from './RunStep';
import type { Lessons } from './store';

/** As the sections are cited. */
const PAPER = 'Paper of Tariverdi and others, 2021, arXiv:2111.13969';

interface Props {
  readonly store: Lessons;
  readonly lesson: Lesson;
}

function Predict(props: Props): JSX.Element {
  const { store, lesson } = props;
  return (
    <fieldset class="lesson-choices" role="radiogroup" aria-labelledby="lesson-question">
      <p id="lesson-question">{lesson.question}</p>
      <For each={Object.entries(lesson.choices)}>
        {([id, text]) => (
          <label>
            <input
              type="radio"
              name={`lesson-${lesson.id}`}
              value={id}
              checked={store.progress().choices[lesson.id] === id}
              onChange={() => store.choose(id)}
            />
            <span>{text}</span>
          </label>
        )}
      </For>
    </fieldset>
  );
}

function Explain(props: Props): JSX.Element {
  const { store, lesson } = props;
  const chosen = (): string => store.progress().choices[lesson.id] ?? '';
  const isRight = (): boolean => store.result()?.outcome === chosen();
  return (
    <>
      <Show
        when={store.result()}
        fallback={
          <p class="hint">You have done this lesson. Run it again to see your numbers here.</p>
        }
      >
        {(result) => (
          <>
            <dl class="lesson-verdict" data-right={isRight()}>
              <div>
                <dt>You predicted</dt>
                <dd>{lesson.choices[chosen()] ?? 'no prediction'}</dd>
                <dd class="lesson-mark">
                  <Icon of={isRight() ? CircleCheck : CircleX} />
                  {isRight() ? 'Right' : 'Not right'}
                </dd>
              </div>
              <div>
                <dt>Measured</dt>
                <dd data-testid="lesson-outcome">{lesson.choices[result().outcome]}</dd>
              </div>
            </dl>
            <dl class="facts lesson-facts" aria-label="Measured in your run">
              <For each={result().facts}>
                {([name, value]) => <Fact name={name} value={value} />}
              </For>
            </dl>
          </>
        )}
      </Show>
      <For each={lesson.why}>
        {(words) => (
          <p>
            <Named words={words} />
          </p>
        )}
      </For>
      <p class="lesson-paper">
        {PAPER}: {lesson.paper}
      </p>
      <p class="lesson-counted">
        <Icon of={CircleCheck} />
        Lesson done: {store.doneCount()} of {LESSONS.length}.
      </p>
    </>
  );
}

export function LessonView(props: Props & { lab: Session & Trial & Events }): JSX.Element {
  const { lab, store, lesson } = props;
  let heading!: HTMLHeadingElement;
  const chosen = (): string => store.progress().choices[lesson.id] ?? '';
  const why = (): string | undefined => {
    if (isLast() || store.mayGoOn()) return undefined;
    return store.step() === 0 ? 'Choose a prediction first' : 'Do the tasks first';
  };
  const runs = lesson.runs.map((_, index) => (lesson.runs.length > 1 ? `Run ${index + 1}` : 'Run'));
  const names = ['Predict', ...runs, 'Explain'];
  const isLast = (): boolean => store.step() === names.length - 1;
  const foot = (left?: JSX.Element): JSX.Element => (
    <footer class="inspector-foot lesson-foot">
      {left}
      <button
        type="button"
        classList={{ primary: isLast() ? !store.following() : store.mayGoOn() }}
        disabled={!isLast() && !store.mayGoOn()}
        title={why()}
        onClick={() => (isLast() ? store.close() : store.go(store.step() + 1))}
      >
        {isLast() ? 'Finish' : 'Next'}
      </button>
      <Show when={isLast() && store.following()}>
        {(following) => (
          <button
            type="button"
            class="primary"
            title={following().title}
            onClick={() => store.open(following())}
          >
            Next lesson
          </button>
        )}
      </Show>
    </footer>
  );
  createEffect(
    on(store.step, () => {
      heading.focus({ preventScroll: true });
      heading.closest('.inspector-panel')?.scrollTo(0, 0);
    }),
  );
  return (
    <>
      <header class="lesson-head stack">
        <div>
          <button type="button" class="ghost small" onClick={store.close}>
            <Icon of={ArrowLeft} />
            All lessons
          </button>
          <Show when={store.step() > 0}>
            <button type="button" class="ghost small" onClick={() => store.go(store.step() - 1)}>
              Back
            </button>
          </Show>
        </div>
        <h2>{lesson.title}</h2>
        <ol class="lesson-steps plain" aria-label="Steps">
          <For each={names}>
            {(name, index) => (
              <li
                classList={{ done: index() < store.step() }}
                aria-current={store.step() === index() ? 'step' : undefined}
              >
                {index() + 1} {name}
              </li>
            )}
          </For>
        </ol>
      </header>
      <h3 ref={heading} class="visually-hidden" tabindex="-1">
        {names[store.step()]}
      </h3>
      <Switch>
        <Match when={store.step() === 0}>
          <Predict store={store} lesson={lesson} />
          {foot()}
        </Match>
        <Match when={store.run()} keyed>
          {(run) => (
            <RunStep
              lab={lab}
              store={store}
              run={run}
              prediction={lesson.choices[chosen()]}
              foot={foot}
            />
          )}
        </Match>
        <Match when={isLast()}>
          <Explain store={store} lesson={lesson} />
          {foot()}
        </Match>
      </Switch>
    </>
  );
}

// One lesson, one step at a time: predict, run, explain.

import { For, Match, Show, Switch, createEffect, on, type JSX } from 'solid-js';
import type { Session, Trial } from '../../lab/slices';
import { Fact } from '../../ui/Fact';
import type { Lesson } from './lesson';
import { RunStep } from './RunStep';
import type { Lessons } from './store';
import { SmallButton } from '../../ui/SmallButton';

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
  return (
    <>
      <Show
        when={store.result()}
        fallback={
          <p class="lesson-note">
            You have done this lesson. Run it again to see your numbers here.
          </p>
        }
      >
        {(result) => (
          <>
            <dl class="lesson-verdict" data-right={result().outcome === chosen()}>
              <Show when={result().outcome !== chosen()}>
                <div>
                  <dt>Your prediction</dt>
                  <dd>{lesson.choices[chosen()] ?? 'no prediction'}</dd>
                </div>
              </Show>
              <div>
                <dt>{result().outcome === chosen() ? 'You were right' : 'What happened'}</dt>
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
      <For each={lesson.why}>{(words) => <p>{words}</p>}</For>
      <p class="lesson-paper">Paper: {lesson.paper}</p>
    </>
  );
}

export function LessonView(props: Props & { lab: Session & Trial }): JSX.Element {
  const { lab, store, lesson } = props;
  let heading!: HTMLHeadingElement;
  let body!: HTMLDivElement;
  const runs = lesson.runs.map((_, index) => (lesson.runs.length > 1 ? `Run ${index + 1}` : 'Run'));
  const names = ['Predict', ...runs, 'Explain'];
  const isLast = (): boolean => store.step() === names.length - 1;
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
          onClick={store.close}
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
            <Predict store={store} lesson={lesson} />
          </Match>
          <Match when={store.run()} keyed>
            {(run) => <RunStep lab={lab} store={store} run={run} />}
          </Match>
          <Match when={isLast()}>
            <Explain store={store} lesson={lesson} />
          </Match>
        </Switch>
      </div>
      <footer class="lesson-foot">
        <SmallButton disabled={store.step() === 0} onClick={() => store.go(store.step() - 1)}>
          Back
        </SmallButton>
        <SmallButton
          classList={{ primary: isLast() || store.mayGoOn() }}
          disabled={!isLast() && !store.mayGoOn()}
          onClick={() => (isLast() ? store.close() : store.go(store.step() + 1))}
        >
          {isLast() ? 'Finish' : 'Next'}
        </SmallButton>
      </footer>
    </>
  );
}

// The list of lessons, or the open lesson.

import { ChevronRight, CircleCheck } from 'lucide';
import { For, Show, onMount, untrack, type JSX } from 'solid-js';
import { Icon } from '../../ui/Icon';
import { LessonView } from './LessonView';
import { LESSONS } from './lessons';
import { lessonsOf, type Lessons, type LessonsLab } from './store';
import './lessons.css';

function LessonList(props: { store: Lessons }): JSX.Element {
  const { store } = props;
  const cards = new Map<string, HTMLButtonElement>();
  onMount(() => {
    // Focus returns to the lesson that was open.
    const left = untrack(store.left);
    if (left) cards.get(left.id)?.focus();
  });
  const done = (): number => store.progress().done.length;
  const isFresh = (): boolean => done() === 0 && Object.keys(store.progress().choices).length === 0;
  return (
    <>
      <section class="panel-intro">
        <h2>Lessons</h2>
        <p class="hint">
          In each one: predict, run one or two experiments, then read why.{' '}
          <span class="number">
            {done()} of {LESSONS.length} done.
          </span>
        </p>
      </section>
      <ol class="list">
        <For each={LESSONS}>
          {(lesson) => {
            const isDone = (): boolean => store.progress().done.includes(lesson.id);
            return (
              <li>
                <button
                  ref={(card) => cards.set(lesson.id, card)}
                  type="button"
                  class="list-row"
                  onClick={() => store.open(lesson)}
                >
                  <span>
                    <strong>
                      {lesson.title}
                      <Show when={isDone()}>
                        <span class="visually-hidden"> (done)</span>
                      </Show>
                    </strong>
                    <small>
                      {lesson.aim} {lesson.minutes} min
                    </small>
                  </span>
                  <Show when={isDone()} fallback={<Icon of={ChevronRight} />}>
                    <Icon of={CircleCheck} class="lesson-done" />
                  </Show>
                </button>
              </li>
            );
          }}
        </For>
      </ol>
      <button
        type="button"
        class="start-over"
        disabled={isFresh()}
        title="Forgets your predictions and which lessons are done"
        onClick={store.startOver}
      >
        Start over
      </button>
    </>
  );
}

export default function LessonsPanel(props: { lab: LessonsLab }): JSX.Element {
  const { lab } = props;
  const store = lessonsOf(lab);
  return (
    <>
      <Show when={store.lesson() === undefined && lab.address.lesson()}>
        {(name) => <p role="alert">There is no lesson “{name()}”.</p>}
      </Show>
      <Show when={store.lesson()} fallback={<LessonList store={store} />} keyed>
        {(lesson) => <LessonView lab={lab} store={store} lesson={lesson} />}
      </Show>
    </>
  );
}

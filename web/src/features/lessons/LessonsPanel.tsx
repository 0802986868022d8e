// The list of lessons, or the open lesson.

import { For, Show, onMount, untrack, type JSX } from 'solid-js';
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
      <p class="lessons-intro">
        In each lesson: predict, run one or two experiments, then read why.{' '}
        <span class="number">
          {done()} of {LESSONS.length} done.
        </span>
      </p>
      <ol class="lesson-list">
        <For each={LESSONS}>
          {(lesson) => {
            const isDone = (): boolean => store.progress().done.includes(lesson.id);
            return (
              <li>
                <button
                  ref={(card) => cards.set(lesson.id, card)}
                  type="button"
                  class="lesson-card"
                  classList={{ done: isDone() }}
                  onClick={() => store.open(lesson)}
                >
                  <span class="lesson-title">
                    {lesson.title}
                    <Show when={isDone()}>
                      <span class="lesson-done">
                        <span aria-hidden="true">✓</span>
                        <span class="visually-hidden">(done)</span>
                      </span>
                    </Show>
                  </span>
                  <span class="lesson-aim">
                    {lesson.aim} <span class="lesson-minutes">{lesson.minutes} min</span>
                  </span>
                </button>
              </li>
            );
          }}
        </For>
      </ol>
      <button
        type="button"
        class="small start-over"
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
    <div class="lessons">
      <Show when={store.lesson() === undefined && lab.address.lesson()}>
        {(name) => <p role="alert">There is no lesson “{name()}”.</p>}
      </Show>
      <Show when={store.lesson()} fallback={<LessonList store={store} />} keyed>
        {(lesson) => <LessonView lab={lab} store={store} lesson={lesson} />}
      </Show>
    </div>
  );
}

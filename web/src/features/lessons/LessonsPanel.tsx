// The list of lessons, or the open lesson.

import { Check, Link } from 'lucide';
import { For, Show, createMemo, createSignal, onMount, untrack, type JSX } from 'solid-js';
import { lessonCopy } from '../../lab/copyLink';
import { Icon } from '../../ui/Icon';
import { LinkRow } from '../../ui/LinkRow';
import type { Lesson } from './lesson';
import { LessonView } from './LessonView';
import { GROUPS, LESSONS } from './lessons';
import { lessonsOf, type Lessons, type LessonsLab } from './store';
import './lessons.css';

/** One lesson: it opens by a press, and its link is for others. */
function LessonRow(props: {
  store: Lessons;
  lesson: Lesson;
  /** Whether it is the next one to do. */
  isNext: boolean;
  isLinked: boolean;
  onLink: () => void;
  ref: (row: HTMLButtonElement) => void;
}): JSX.Element {
  const { store, lesson } = props;
  return (
    <li class="lesson-item" classList={{ next: props.isNext }}>
      <button ref={props.ref} type="button" class="list-row" onClick={() => store.open(lesson)}>
        <span class="lesson-number" aria-hidden="true">
          <Show when={store.isDone(lesson)} fallback={LESSONS.indexOf(lesson) + 1}>
            <Icon of={Check} />
          </Show>
        </span>
        <span>
          <strong>
            {lesson.title}
            <Show when={store.isDone(lesson)}>
              <span class="visually-hidden"> (done)</span>
            </Show>
            <Show when={props.isNext}>
              <span class="visually-hidden"> (next)</span>
            </Show>
          </strong>
          <small>
            {lesson.aim} {`${lesson.minutes}\u00a0min`}
          </small>
        </span>
      </button>
      <button
        type="button"
        class="ghost icon-only"
        aria-label={`Link to ${lesson.title}`}
        title="A link for a class"
        aria-expanded={props.isLinked}
        onClick={() => props.onLink()}
      >
        <Icon of={Link} />
      </button>
      <Show when={props.isLinked}>
        <LinkRow title={`Lesson ${lesson.title}`} address={lessonCopy(lesson.id)}>
          For a class: it opens this lesson in a session of each reader’s own.
        </LinkRow>
      </Show>
    </li>
  );
}

function LessonList(props: { store: Lessons }): JSX.Element {
  const { store } = props;
  const rows = new Map<string, HTMLButtonElement>();
  const [linked, setLinked] = createSignal<Lesson>();
  onMount(() => {
    // Focus returns to the lesson that was open.
    const left = untrack(store.left);
    if (left) rows.get(left.id)?.focus();
  });
  const isFresh = (): boolean =>
    store.doneCount() === 0 && Object.keys(store.progress().choices).length === 0;
  const next = createMemo(() => LESSONS.find((one) => !store.isDone(one)));
  return (
    <>
      <section class="panel-intro">
        <h2>Lessons</h2>
        <p class="hint">
          In each one: predict, run one or two experiments, then read why.{' '}
          <span class="number">
            {store.doneCount()} of {LESSONS.length} done.
          </span>
        </p>
      </section>
      <For each={GROUPS}>
        {({ title, lessons }) => (
          <section aria-label={title}>
            <h3>{title}</h3>
            <ol class="list">
              <For each={lessons}>
                {(lesson) => (
                  <LessonRow
                    store={store}
                    lesson={lesson}
                    isNext={next() === lesson}
                    isLinked={linked() === lesson}
                    onLink={() => setLinked(linked() === lesson ? undefined : lesson)}
                    ref={(row) => rows.set(lesson.id, row)}
                  />
                )}
              </For>
            </ol>
          </section>
        )}
      </For>
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

// The open lesson, its step, and the measurements of its experiments. The store lives as long as the page, so that a
// lesson continues while the user looks at another tab.

import { createEffect, createMemo, createRoot, createSignal, on } from 'solid-js';
import type { Vec2 } from '../../lab/geometry';
import { loadLink } from '../../lab/loadTrial';
import type { Addressed, Events, Layers, Pictures, Session, Trial } from '../../lab/slices';
import { shareWords } from '../../lab/trainingStage';
import type { Parameters } from '../../net/protocol.gen';
import { recall, remember } from '../../ui/storage';
import {
  type Fact,
  isTraining,
  isTrainingLesson,
  type Lesson,
  type Run,
  type Task,
  tasksOf,
} from './lesson';
import { createLessonTrainings } from './lessonTrainings';
import { LESSONS } from './lessons';
import { NO_PROGRESS, type Progress, progressFrom } from './progress';
import { isSame, startTrack, observe, type Track } from './track';

const KEY = 'lessons';

interface Result {
  readonly outcome: string;
  readonly facts: readonly Fact[];
}

export type LessonsLab = Addressed & Session & Trial & Events & Pictures & Layers;

/** The measurements of all runs, or undefined if one is missing. */
function all<R, M>(runs: readonly R[], measured: (run: R) => M | undefined): M[] | undefined {
  const found = runs.map(measured).filter((one) => one !== undefined);
  return found.length === runs.length ? found : undefined;
}

function createLessons(lab: LessonsLab) {
  const [progress, setProgress] = createSignal(progressFrom(recall(KEY), LESSONS));
  const [lesson, setLesson] = createSignal<Lesson>();
  const [left, setLeft] = createSignal<Lesson>();
  const [step, setStep] = createSignal(0);
  const [tracks, setTracks] = createSignal<ReadonlyMap<Run, Track>>(new Map());
  /** Layers that the lesson switched on and has to switch off again. */
  let lent: readonly string[] = [];
  /** Parameters and speed before the lesson's first experiment. */
  let before: { readonly parameters: Parameters; readonly speed: number } | undefined;

  const keep = (next: Progress): void => {
    setProgress(next);
    remember(KEY, JSON.stringify(next));
  };
  const isDone = (one: Lesson): boolean => progress().done.includes(one.id);
  const run = createMemo(() => lesson()?.runs[step() - 1]);
  const experiment = createMemo(() => {
    const now = run();
    return now && !isTraining(now) ? now : undefined;
  });
  const trainings = createLessonTrainings(lab.catalog);
  const track = createMemo(() => {
    const now = experiment();
    return now && tracks().get(now);
  });
  const isElsewhere = (): boolean => {
    const now = track();
    return now !== undefined && now.trial !== lab.scene()?.trial;
  };
  const isFollowed = (): boolean => track() !== undefined && !isElsewhere();
  /** Whether the user has moved the goal of the experiment: its tasks count no delivery to another one. */
  const isGoalMoved = (): boolean => {
    const [now, goal_m] = [track(), lab.state()?.goal_m];
    if (!isFollowed() || !now?.runGoal_m) return false;
    const at: Vec2 | null = goal_m ? [goal_m[0], goal_m[1]] : null;
    return ![now.runGoal_m, experiment()?.nextGoal_m ?? null].some((one) => isSame(one, at));
  };
  const tasks = createMemo((): readonly Task[] => {
    const now = experiment();
    return now ? tasksOf(now) : [];
  });
  const isTaskDone = (task: Task): boolean => {
    const now = track();
    return now !== undefined && task.done(now);
  };
  /** The scenario of the present run, as the server has set it up. A reset begins it again. */
  const [own, setOwn] = createSignal<string>();
  const scenario = createMemo(() => JSON.stringify(lab.scene()?.scenario));

  createEffect(() => {
    const [now, scene, state] = [experiment(), lab.scene(), lab.state()];
    if (!now || !scene || !state) return;
    const frame = { scene, state, overlay: lab.overlay(), marks: lab.marks() };
    // Before the first tick, so that nothing is missed.
    const isAtStart = scenario() === own() && state.tick === 0;
    setTracks((known) => {
      const followed = known.get(now);
      if (isAtStart) return new Map(known).set(now, startTrack(frame));
      return followed?.trial === scene.trial
        ? new Map(known).set(now, observe(followed, frame))
        : known;
    });
  });

  /** Switches these layers on, and those of the run before off again. */
  const lend = (layers: readonly string[]): void => {
    const next = layers.filter((layer) => lent.includes(layer) || !lab.layers().has(layer));
    for (const layer of lent) if (!next.includes(layer)) lab.showLayer(layer, false);
    for (const layer of next) lab.showLayer(layer, true);
    lent = next;
  };
  /** Restores parameters and speed, unless the user has loaded something else meanwhile. */
  const restore = (): void => {
    const isStillThere = [...tracks().values()].some(({ trial }) => trial === lab.scene()?.trial);
    if (before && isStillThere && lab.canOperate()) {
      void lab.send('playback', { type: 'configure', parameters: before.parameters });
      void lab.send('playback', { type: 'set_speed', factor: before.speed });
    }
    before = undefined;
  };
  const go = (to: number): void => {
    setOwn(undefined);
    setStep(to);
  };
  const leave = (): void => {
    lend([]);
    restore();
    setLeft(lesson());
    setLesson(undefined);
    go(0);
    setTracks(new Map());
    trainings.forget();
  };

  // Also by the browser's Back.
  createEffect(
    on(lab.address.lesson, (id) => {
      leave();
      setLesson(LESSONS.find((one) => one.id === id));
    }),
  );

  return {
    progress,
    isDone,
    doneCount: (): number => progress().done.length,
    lesson,
    /** The lesson that was open before. */
    left,
    /** 0 is Predict, then come the runs, then Explain. */
    step,
    /** The experiment or the training of the present step. */
    run,
    trainings,
    /** The measurements of the present experiment, if it was set up. */
    track,
    /** Whether the page shows an experiment other than the followed one. */
    isElsewhere,
    /** Whether the page shows the present experiment, as it was set up. */
    isFollowed,
    isGoalMoved,
    /** What the present experiment asks for. */
    tasks,
    isTaskDone,
    tasksDone: (): number => tasks().filter(isTaskDone).length,
    nextTask: (): Task | undefined =>
      isFollowed() ? tasks().find((one) => !isTaskDone(one)) : undefined,
    /** Whether the user may go to the next step. */
    mayGoOn: (): boolean => {
      const [now, here, measured] = [lesson(), run(), track()];
      if (!now) return false;
      if (!here) return progress().choices[now.id] !== undefined;
      if (isDone(now)) return true;
      if (isTraining(here)) return trainings.summary(here)?.stage === 'done';
      return measured !== undefined && tasksOf(here).every((task) => task.done(measured));
    },
    /** Outcome and facts, if all runs were done since the lesson was opened. */
    result: (): Result | undefined => {
      const now = lesson();
      if (!now) return undefined;
      if (isTrainingLesson(now)) {
        const examined = all(now.runs, (one) => trainings.summary(one)?.examined ?? undefined);
        return (
          examined && {
            outcome: now.outcome(...examined),
            facts: examined.map((one, index) => [
              now.runs[index]?.title ?? '',
              `${shareWords(one)} episodes`,
            ]),
          }
        );
      }
      const measured = all(now.runs, (one) => tracks().get(one));
      return measured && { outcome: now.outcome(...measured), facts: now.facts(...measured) };
    },
    /** The first lesson after this one that is not done. */
    following: (): Lesson | undefined => {
      const now = lesson();
      return now && LESSONS.slice(LESSONS.indexOf(now) + 1).find((one) => !isDone(one));
    },
    open: ({ id }: Lesson): void => lab.address.learn(id),
    close: (): void => lab.address.learn(undefined),
    /** The lesson is done when its last step is shown. */
    go: (to: number): void => {
      go(to);
      const now = lesson();
      if (now && to > now.runs.length && !isDone(now))
        keep({ ...progress(), done: [...progress().done, now.id] });
    },
    choose: (choice: string): void => {
      const now = lesson();
      if (now) keep({ ...progress(), choices: { ...progress().choices, [now.id]: choice } });
    },
    /** Loads the run's experiment. */
    setUp: async (next: Run): Promise<void> => {
      const scene = lab.scene();
      if (!scene) return;
      before ??= { parameters: scene.parameters, speed: lab.state()?.speed_target ?? 1 };
      setTracks((known) => new Map([...known].filter(([one]) => one !== next)));
      const loaded = loadLink(lab, 'playback', next.link);
      void lab.send('playback', { type: 'set_speed', factor: next.speed ?? 1 });
      lend(next.layers);
      const answer = await loaded;
      if (answer?.kind === 'done' && run() === next) setOwn(scenario());
    },
    startOver: (): void => keep(NO_PROGRESS),
  };
}

export type Lessons = ReturnType<typeof createLessons>;

const stores = new WeakMap<LessonsLab, Lessons>();

/** The lessons of a laboratory. Created once and shared by all panels. */
export function lessonsOf(lab: LessonsLab): Lessons {
  let store = stores.get(lab);
  if (!store) {
    store = createRoot(() => createLessons(lab));
    stores.set(lab, store);
  }
  return store;
}

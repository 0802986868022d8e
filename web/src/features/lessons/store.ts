// The open lesson, its step, and the measurements of its experiments. The store lives as long as the page, so that a
// lesson continues while the user looks at another tab.

import {
  createEffect,
  createMemo,
  createRoot,
  createSignal,
  untrack,
  type Accessor,
} from 'solid-js';
import { experimentFrom, loadMessage } from '../../lab/experimentLink';
import { knownBy } from '../../lab/known';
import {
  allDone,
  isTrainingLesson,
  type Lesson,
  runCount,
  type Run,
  type TrainingRun,
} from './lesson';
import { createLessonTrainings, type LessonTrainings } from './lessonTrainings';
import { LESSONS } from './lessons';
import { NO_PROGRESS, type Progress, storedProgress, storeProgress } from './progress';
import { startTrack, observe, type Track } from './track';
import type { Events, Layers, Pictures, Session, Trial } from '../../lab/slices';
import type { Parameters } from '../../net/protocol.gen';

type Tracks = readonly (Track | undefined)[];

export interface Lessons {
  readonly progress: Accessor<Progress>;
  readonly lesson: Accessor<Lesson | undefined>;
  /** The lesson that was open before. */
  readonly left: Accessor<Lesson | undefined>;
  /** 0 is Predict, then come the runs, then Explain. */
  readonly step: Accessor<number>;
  readonly run: Accessor<Run | undefined>;
  /** The training of the present step, in a lesson with trainings. */
  readonly training: Accessor<TrainingRun | undefined>;
  readonly trainings: LessonTrainings;
  /** One per run that was set up. */
  readonly tracks: Accessor<Tracks>;
  readonly track: Accessor<Track | undefined>;
  /** Whether the page shows an experiment other than the followed one. */
  readonly isElsewhere: Accessor<boolean>;
  /** Whether the user may go to the next step. */
  readonly mayGoOn: Accessor<boolean>;
  open(lesson: Lesson): void;
  close(): void;
  /** The lesson is done when its last step is shown. */
  go(step: number): void;
  choose(choice: string): void;
  /** Loads the run's experiment. */
  setUp(): Promise<void>;
  startOver(): void;
}

export type LessonsLab = Session & Trial & Events & Pictures & Layers;

function createLessons(lab: LessonsLab): Lessons {
  const [progress, setProgress] = createSignal(storedProgress(LESSONS));
  const [lesson, setLesson] = createSignal<Lesson>();
  const [left, setLeft] = createSignal<Lesson>();
  const [step, setStep] = createSignal(0);
  const [tracks, setTracks] = createSignal<Tracks>([]);
  /** Layers that the lesson switched on and has to switch off again. */
  let lent: readonly string[] = [];
  /** Parameters and speed before the lesson's first experiment. */
  let before: { readonly parameters: Parameters; readonly speed: number } | undefined;

  const keep = (next: Progress): void => {
    setProgress(next);
    storeProgress(next);
  };
  const run = createMemo(() => {
    const now = lesson();
    return now && !isTrainingLesson(now) ? now.runs[step() - 1] : undefined;
  });
  const training = createMemo(() => {
    const now = lesson();
    return now && isTrainingLesson(now) ? now.trainings[step() - 1] : undefined;
  });
  const trainings = createLessonTrainings(lab.catalog, lesson);
  const track = createMemo(() => tracks()[step() - 1]);
  /** The scenario of the present run, as the server has set it up. A reset begins it again. */
  const [own, setOwn] = createSignal<string>();
  const isItsTrial = createMemo(() => {
    const scene = lab.scene();
    return scene !== undefined && JSON.stringify(scene.scenario) === own();
  });

  createEffect(() => {
    const [scene, state, isOwn] = [lab.scene(), lab.state(), isItsTrial()];
    if (!run() || !scene || !state) return;
    const frame = { scene, state, overlay: lab.overlay(), marks: lab.marks() };
    untrack(() => {
      const before = track();
      const isFollowed = before?.trial === scene.trial;
      // Before the first tick, so that nothing is missed.
      const isAtStart = isOwn && state.tick === 0;
      if (!isFollowed && !isAtStart) return;
      const next = isAtStart ? startTrack(frame) : before && observe(before, frame);
      const all = [...tracks()];
      all[step() - 1] = next;
      setTracks(all);
    });
  });

  /** Switches the lesson's layers off, except those in `still`. */
  const giveBackLayers = (still: readonly string[] = []): void => {
    for (const layer of lent) if (!still.includes(layer)) lab.showLayer(layer, false);
    lent = lent.filter((layer) => still.includes(layer));
  };
  /** Restores parameters and speed, unless the user has loaded something else meanwhile. */
  const restore = (): void => {
    const isStillThere = tracks().some((one) => one && one.trial === lab.scene()?.trial);
    if (before && isStillThere && lab.canOperate()) {
      void lab.send('playback', { type: 'configure', parameters: before.parameters });
      void lab.send('playback', { type: 'set_speed', factor: before.speed });
    }
    before = undefined;
  };
  const leave = (): void => {
    giveBackLayers();
    restore();
    setLeft(lesson());
    setLesson(undefined);
    setOwn(undefined);
    setStep(0);
    setTracks([]);
  };

  return {
    progress,
    lesson,
    left,
    step,
    run,
    training,
    trainings,
    tracks,
    track,
    isElsewhere: () => {
      const now = track();
      return now !== undefined && now.trial !== lab.scene()?.trial;
    },
    mayGoOn: () => {
      const now = lesson();
      if (!now) return false;
      if (step() === 0) return progress().choices[now.id] !== undefined;
      if (progress().done.includes(now.id)) return true;
      if (training()) return trainings.summaries()[step() - 1]?.stage === 'done';
      const here = run();
      return !here || allDone(here, track());
    },
    open(next) {
      leave();
      setLesson(next);
    },
    close: leave,
    go(to) {
      setOwn(undefined);
      setStep(to);
      const now = lesson();
      if (now && to > runCount(now) && !progress().done.includes(now.id))
        keep({ ...progress(), done: [...progress().done, now.id] });
    },
    choose(choice) {
      const now = lesson();
      if (now) keep({ ...progress(), choices: { ...progress().choices, [now.id]: choice } });
    },
    async setUp() {
      const [here, scene, known] = [run(), lab.scene(), knownBy(lab)];
      if (!here || !scene || !known) return;
      const read = experimentFrom(here.link, known);
      if (read.kind !== 'experiment') return;
      before ??= { parameters: scene.parameters, speed: lab.state()?.speed_target ?? 1 };
      setTracks(tracks().map((old, index) => (index === step() - 1 ? undefined : old)));
      const loaded = lab.send('playback', loadMessage(read.experiment, scene.defaults));
      void lab.send('playback', { type: 'set_speed', factor: here.speed });
      giveBackLayers(here.layers);
      const off = here.layers.filter((layer) => !lab.layers().has(layer));
      for (const layer of off) lab.showLayer(layer, true);
      lent = [...lent, ...off];
      const { kind } = await loaded;
      if (kind === 'done' && run() === here) setOwn(JSON.stringify(lab.scene()?.scenario));
    },
    startOver() {
      leave();
      keep(NO_PROGRESS);
    },
  };
}

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

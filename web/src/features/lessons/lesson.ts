// The parts of a lesson. Pure.

import type {
  ClientMessage,
  Examination,
  SceneMessage,
  StateMessage,
  TrainingSettings,
} from '../../net/protocol.gen';
import type { Track } from './track';

export interface Choice {
  readonly id: string;
  readonly text: string;
}

/** Something that the user has to see happen. */
export interface Task {
  readonly text: string;
  readonly done: (track: Track) => boolean;
}

/** A button of a lesson that sends a command. */
export interface Action {
  readonly label: string;
  readonly message: (scene: SceneMessage, state: StateMessage) => ClientMessage;
}

/** One experiment of a lesson. */
export interface Run {
  /** Only for lessons with several runs. */
  readonly title?: string;
  /** The hash of an experiment link. */
  readonly link: string;
  /** Playback speed. */
  readonly speed: number;
  /** Layers that are switched on with the run. */
  readonly layers: readonly string[];
  /** Instructions, one paragraph each. */
  readonly words: readonly string[];
  readonly tasks: readonly Task[];
  readonly actions: readonly Action[];
}

/** A measured value with its unit. */
export type Fact = readonly [name: string, value: string];

/** A training of the small map `u-turn`. */
export interface TrainingRun {
  readonly title: string;
  /** Name of its policy. */
  readonly policy: string;
  /** What differs from the recipe `quick`. */
  readonly settings: Partial<TrainingSettings>;
  /** The policy whose weights it starts from. */
  readonly startFrom?: string;
  /** Instructions, one paragraph each. */
  readonly words: readonly string[];
}

/** `M` is what is measured in a run. */
interface Frame<M> {
  readonly id: string;
  readonly title: string;
  readonly aim: string;
  readonly minutes: number;
  readonly question: string;
  readonly choices: readonly Choice[];
  /** Id of the choice that came true. There is one measurement per run. */
  readonly outcome: (measured: readonly M[]) => string;
  readonly facts: (measured: readonly M[]) => readonly Fact[];
  readonly why: readonly string[];
  /** Section of the paper. */
  readonly paper: string;
}

export interface ExperimentLesson extends Frame<Track> {
  readonly runs: readonly [Run, ...Run[]];
}

export interface TrainingLesson extends Frame<Examination> {
  readonly trainings: readonly [TrainingRun, ...TrainingRun[]];
}

export type Lesson = ExperimentLesson | TrainingLesson;

export const isTrainingLesson = (lesson: Lesson): lesson is TrainingLesson => 'trainings' in lesson;

/** The experiments of a lesson. */
export const runsOf = (lesson: Lesson): readonly Run[] =>
  isTrainingLesson(lesson) ? [] : lesson.runs;

export const runCount = (lesson: Lesson): number =>
  isTrainingLesson(lesson) ? lesson.trainings.length : lesson.runs.length;

export function allDone(run: Run, track: Track | undefined): boolean {
  return track !== undefined && run.tasks.every((task) => task.done(track));
}

// Tasks of several lessons.

export const RUNNING: Task = {
  text: 'The simulation runs: press Run or the space bar',
  done: (track) => track.time_s > 0.3,
};

export const DELIVERED: Task = {
  text: 'Delivered: bead within 20 mm of the goal',
  done: (track) => track.deliveries.length > 0,
};

/** In a run where the bead is lost: a delivery before that does not count. */
export const DELIVERED_AFTER_FETCH: Task = {
  text: 'Fetched and then delivered: bead within 20 mm of the goal',
  done: ({ deliveries, fetchedAt_s = Infinity }) =>
    deliveries.some(({ time_s }) => time_s > fetchedAt_s),
};

/** When the first goal was delivered, as text. */
export function deliveryWords(track: Track | undefined): string {
  const first = track?.deliveries[0];
  if (first) return `after ${first.time_s.toFixed(1)} s`;
  return track?.stopped ? 'never: it stopped after 150 steps' : 'not yet';
}

// The parts of a lesson. Pure.

import type {
  ClientMessage,
  Examination,
  SceneMessage,
  TrainingSettings,
} from '../../net/protocol.gen';
import type { Vec2 } from '../../lab/geometry';
import { seconds } from '../../ui/format';
import { deliveriesTo, type Track } from './track';

/** Something that the user has to see happen. */
export interface Task {
  readonly text: string;
  readonly done: (track: Track) => boolean;
}

/** A button of a lesson that sends a command. */
export interface Action {
  readonly label: string;
  readonly message: (scene: SceneMessage) => ClientMessage;
}

/** One experiment of a lesson. */
export interface Run {
  /** Only for lessons with several runs. */
  readonly title?: string;
  /** The hash of an experiment link. */
  readonly link: string;
  /** Playback speed, if it is not 1. */
  readonly speed?: number;
  /** Layers that are switched on with the run. */
  readonly layers: readonly string[];
  /** Instructions, one paragraph each, with the names of buttons and layers between asterisks. */
  readonly words: readonly string[];
  /** After the first one, which is to run it. */
  readonly tasks: readonly Task[];
  readonly actions?: readonly Action[];
  /** The goal that one of the actions places. */
  readonly nextGoal_m?: Vec2;
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
interface Steps<R, M> {
  readonly id: string;
  readonly title: string;
  readonly aim: string;
  readonly minutes: number;
  readonly question: string;
  /** Texts by id. */
  readonly choices: Readonly<Record<string, string>>;
  readonly runs: readonly [R, ...R[]];
  /** Id of the choice that came true. There is one measurement per run. */
  readonly outcome: (...measured: M[]) => string;
  /** Names as in the instructions. */
  readonly why: readonly string[];
  /** Section of the paper. */
  readonly paper: string;
}

export interface ExperimentLesson extends Steps<Run, Track> {
  readonly facts: (...measured: Track[]) => readonly Fact[];
}
export type TrainingLesson = Steps<TrainingRun, Examination>;
export type Lesson = ExperimentLesson | TrainingLesson;

export const isTraining = (run: Run | TrainingRun): run is TrainingRun => 'policy' in run;

export const isTrainingLesson = (lesson: Lesson): lesson is TrainingLesson =>
  isTraining(lesson.runs[0]);

const RUNNING: Task = {
  text: 'The simulation runs: press Run or the space bar',
  done: (track) => track.time_s > 0.3,
};

export const tasksOf = (run: Run): readonly Task[] => [RUNNING, ...run.tasks];

// Tasks and measurements of several lessons.

/** Whether the bead was delivered to the goal with which the run begins. */
export const isDelivered = (track: Track): boolean => deliveriesTo(track).length > 0;

export const DELIVERED: Task = {
  text: 'Delivered: bead within 2 cm of the goal',
  done: isDelivered,
};

/** In a run where the bead is lost: a delivery before that does not count. */
export const DELIVERED_AFTER_FETCH: Task = {
  text: 'Fetched and then delivered: bead within 2 cm of the goal',
  done: (track) =>
    deliveriesTo(track).some(({ time_s }) => time_s > (track.fetchedAt_s ?? Infinity)),
};

/** When the goal of the run was delivered first. */
export const delivery_s = (track: Track): number => deliveriesTo(track)[0]?.time_s ?? Infinity;

/** Whether a delivery took much longer than one before. */
export const isSlower = (now: Track, before: Track): boolean =>
  delivery_s(now) > 1.25 * delivery_s(before);

/** The same as text. */
export function deliveryWords(track: Track): string {
  if (isDelivered(track)) return `after ${seconds(delivery_s(track))}`;
  return track.stopped ? 'never: it stopped after 150 steps' : 'not yet';
}

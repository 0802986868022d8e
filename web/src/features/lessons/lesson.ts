// What a lesson is made of. Pure.

import type { ClientMessage, SceneMessage, StateMessage } from '../../net/protocol.gen';
import type { Track } from './track';

export interface Choice {
  readonly id: string;
  readonly text: string;
}

/** Something to see happen; ticked off when it has. */
export interface Task {
  readonly text: string;
  readonly done: (track: Track) => boolean;
}

/** Something that the lesson does for whom asks, with a command like any other. */
export interface Action {
  readonly label: string;
  readonly message: (scene: SceneMessage, state: StateMessage) => ClientMessage;
}

/** One experiment of a lesson. */
export interface Run {
  /** Only when a lesson has several. */
  readonly title?: string;
  /** The experiment, as any link has it. */
  readonly link: string;
  /** How fast time is to run. */
  readonly speed: number;
  /** Layers that it needs; they are switched on with it. */
  readonly layers: readonly string[];
  /** What to do and what to look at. */
  readonly words: readonly string[];
  readonly tasks: readonly Task[];
  readonly actions: readonly Action[];
}

/** Something measured: its name and its value in words. */
export type Fact = readonly [name: string, value: string];

export interface Lesson {
  readonly id: string;
  readonly title: string;
  readonly aim: string;
  readonly minutes: number;
  readonly question: string;
  readonly choices: readonly Choice[];
  readonly runs: readonly [Run, ...Run[]];
  /** Which choice came true, from a track a run. */
  readonly outcome: (tracks: readonly Track[]) => string;
  readonly facts: (tracks: readonly Track[]) => readonly Fact[];
  readonly why: readonly string[];
  /** Where the paper has it. */
  readonly paper: string;
}

export function allDone(run: Run, track: Track | undefined): boolean {
  return track !== undefined && run.tasks.every((task) => task.done(track));
}

// Tasks that many lessons have.

export const TIME_RUNS: Task = {
  text: 'Time runs: press Run, or Space',
  done: (track) => track.time_s > 0.3,
};

export const DELIVERED: Task = {
  text: 'Delivered: the bead is within 2 cm of the goal',
  done: (track) => track.deliveries.length > 0,
};

/** When the first goal was delivered, in words. */
export function deliveryWords(track: Track | undefined): string {
  const first = track?.deliveries[0];
  if (first) return `after ${first.time_s.toFixed(1)} s`;
  return track?.stopped ? 'never: it gave up after 150 steps' : 'not yet';
}

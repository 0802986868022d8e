// The parts of a lesson. Pure.

import type { ClientMessage, SceneMessage, StateMessage } from '../../net/protocol.gen';
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

export interface Lesson {
  readonly id: string;
  readonly title: string;
  readonly aim: string;
  readonly minutes: number;
  readonly question: string;
  readonly choices: readonly Choice[];
  readonly runs: readonly [Run, ...Run[]];
  /** Id of the choice that came true. There is one track per run. */
  readonly outcome: (tracks: readonly Track[]) => string;
  readonly facts: (tracks: readonly Track[]) => readonly Fact[];
  readonly why: readonly string[];
  /** Section of the paper. */
  readonly paper: string;
}

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

/** When the first goal was delivered, as text. */
export function deliveryWords(track: Track | undefined): string {
  const first = track?.deliveries[0];
  if (first) return `after ${first.time_s.toFixed(1)} s`;
  return track?.stopped ? 'never: it stopped after 150 steps' : 'not yet';
}

// The page's data model, and how messages change it. Pure.

import {
  type ComparisonMessage,
  type EventKind,
  type EventMessage,
  type Hello,
  type OverlayMessage,
  PROTOCOL_VERSION,
  type SceneMessage,
  type SeenMessage,
  type ServerMessage,
  type StateMessage,
} from '../net/protocol.gen';
import type { Picture } from '../net/connection';
import { eventWords } from '../words/events';
import { refusalWords } from '../words/refusals';
import type { AnswerMessage } from './commands';
import { isSameEvent } from './eventStory';
import type { Place } from './places';
import { restartText } from './restart';

/** Largest number of log lines. */
export const LOG_LINES = 300;
/** Largest number of marks on the timeline. */
export const MARKS = 500;

export type ConnectionState =
  | { readonly kind: 'connecting' }
  | { readonly kind: 'live' }
  | { readonly kind: 'lost'; readonly attempt: number }
  /** This page and the server speak different versions. */
  | { readonly kind: 'outdated' };

export interface LogLine {
  readonly id: number;
  /** Simulated time; undefined for events outside the simulation. */
  readonly sim_time_s: number | undefined;
  readonly kind: EventKind | 'error' | 'connection';
  readonly text: string;
  /** The event of the trial, if the line has one. */
  readonly event: EventMessage | undefined;
  /** Number of repetitions in a row. */
  readonly count: number;
}

export interface Notice {
  readonly id: number;
  /** A refusal, or a hint of this page. */
  readonly tone: 'error' | 'hint';
  readonly text: string;
}

export interface Model {
  readonly connection: ConnectionState;
  readonly hello: Hello | undefined;
  readonly scene: SceneMessage | undefined;
  readonly state: StateMessage | undefined;
  readonly overlay: OverlayMessage | undefined;
  readonly obstacleMap: SeenMessage | undefined;
  readonly log: readonly LogLine[];
  readonly marks: readonly EventMessage[];
  /** The last comparison of this trial, possibly still running. */
  readonly comparison: ComparisonMessage | undefined;
  readonly notices: Readonly<Partial<Record<Place, Notice>>>;
  /** Grows when the server has released a bead because it received nothing from the hand. */
  readonly silences: number;
  /** When the server opened the session of the last state. */
  readonly opened: string | undefined;
  readonly nextId: number;
}

/** The lists have a place of their own. */
export type ModelMessage = Exclude<
  ServerMessage,
  AnswerMessage | { type: 'catalog' | 'training_points' }
>;

export type Input =
  | { readonly type: 'connection'; readonly connection: ConnectionState }
  | { readonly type: 'message'; readonly message: ModelMessage }
  /** A state that is not shown, because newer ones have come. */
  | { readonly type: 'passed'; readonly state: StateMessage }
  /** A part of the course. */
  | { readonly type: 'course'; readonly part: Picture }
  | { readonly type: 'sent'; readonly place: Place }
  /** The place that the command was sent from. */
  | { readonly type: 'answer'; readonly place: Place | undefined; readonly answer: AnswerMessage }
  | { readonly type: 'notice'; readonly place: Place; readonly text: string }
  | { readonly type: 'dismiss'; readonly place: Place; readonly id: number };

export const EMPTY: Model = {
  connection: { kind: 'connecting' },
  hello: undefined,
  scene: undefined,
  state: undefined,
  overlay: undefined,
  obstacleMap: undefined,
  log: [],
  marks: [],
  comparison: undefined,
  notices: {},
  silences: 0,
  opened: undefined,
  nextId: 1,
};

function withLine(
  model: Model,
  kind: LogLine['kind'],
  text: string,
  sim_time_s: number | undefined,
  event?: EventMessage,
): Model {
  const last = model.log.at(-1);
  if (last?.kind === kind && last.text === text) {
    return { ...model, log: [...model.log.slice(0, -1), { ...last, count: last.count + 1 }] };
  }
  const line: LogLine = { id: model.nextId, sim_time_s, kind, text, event, count: 1 };
  return {
    ...model,
    log: [...model.log, line].slice(-LOG_LINES),
    nextId: model.nextId + 1,
  };
}

function withNotice(model: Model, place: Place, tone: Notice['tone'], text: string): Model {
  return {
    ...model,
    notices: { ...model.notices, [place]: { id: model.nextId, tone, text } },
    nextId: model.nextId + 1,
  };
}

function withError(model: Model, place: Place, text: string): Model {
  const logged = withLine(model, 'error', text, model.state?.sim_time_s);
  return withNotice(logged, place, 'error', text);
}

function withoutNotice(model: Model, place: Place): Model {
  if (!model.notices[place]) return model;
  const notices = Object.entries(model.notices).filter(([name]) => name !== place);
  return { ...model, notices: Object.fromEntries(notices) };
}

function withConnection(model: Model, connection: ConnectionState): Model {
  const next = { ...model, connection };
  if (connection.kind === 'lost' && model.connection.kind === 'live') {
    // An ended session closes the connection, and the page does not reconnect.
    if (model.state?.ended) return next;
    return withLine(next, 'connection', 'Connection lost. Trying again.', undefined);
  }
  if (connection.kind === 'live' && model.connection.kind === 'lost') {
    // The session sends its events again.
    const own = model.log.filter((line) => line.kind === 'connection' || line.kind === 'error');
    const fresh = { ...next, log: own, marks: [], comparison: undefined };
    return withLine(fresh, 'connection', 'Connected again.', undefined);
  }
  return next;
}

function withState(model: Model, state: StateMessage): Model {
  const isRewound = model.state !== undefined && state.newest_tick < model.state.newest_tick;
  // Events after the rewind may arrive before this state.
  const kept = Math.max(state.newest_tick, state.tick);
  const marks = isRewound ? model.marks.filter((mark) => mark.tick <= kept) : model.marks;
  const next = { ...model, state, marks, opened: model.hello?.opened ?? model.opened };
  const restarted = model.hello && restartText(model.hello, model.opened, state.sim_time_s);
  return restarted === undefined ? next : withNotice(next, 'playback', 'hint', restarted);
}

function withMessage(model: Model, message: ModelMessage): Model {
  switch (message.type) {
    case 'hello': {
      const next: Model = {
        ...model,
        hello: message,
        connection: message.protocol === PROTOCOL_VERSION ? model.connection : { kind: 'outdated' },
      };
      return message.asked && !model.hello?.asked
        ? withLine(next, 'connection', 'Another browser asks for control.', undefined)
        : next;
    }
    case 'scene': {
      // Another trial: overlays, marks and notices of the old one are dropped.
      const otherTrial = model.scene !== undefined && model.scene.trial !== message.trial;
      return otherTrial
        ? {
            ...model,
            scene: message,
            overlay: undefined,
            obstacleMap: undefined,
            comparison: undefined,
            marks: [],
            notices: {},
          }
        : { ...model, scene: message };
    }
    case 'state':
      return withState(model, message);
    case 'overlay':
      return { ...model, overlay: message };
    case 'seen':
      return { ...model, obstacleMap: message };
    case 'event': {
      // A session event at tick 0 means a new setup: earlier marks are dropped.
      const before = message.kind === 'session' && message.tick === 0 ? [] : model.marks;
      const isKnown = before.some((mark) => isSameEvent(mark, message));
      // One object per event: the list of events finds its lines on the timeline by it.
      const logged = message.again
        ? model.log.findLast(({ event }) => event && isSameEvent(event, message))?.event
        : undefined;
      const marks = isKnown ? before : [...before, logged ?? message].slice(-MARKS);
      const marked = { ...model, marks };
      // The log has the past of a run already.
      if (message.again) return marked;
      return withLine(marked, message.kind, eventWords(message.what), message.sim_time_s, message);
    }
    case 'comparison':
      return message.trial === model.scene?.trial ? { ...model, comparison: message } : model;
    // What a hand does has no id.
    case 'error': {
      const silences = model.silences + (message.code === 'hand_silent' ? 1 : 0);
      return withError(
        { ...model, silences },
        'workspace',
        refusalWords({ ...message, detail: message.message }),
      );
    }
  }
}

export function reduce(model: Model, input: Input): Model {
  switch (input.type) {
    case 'connection':
      return withConnection(model, input.connection);
    case 'message':
      return withMessage(model, input.message);
    case 'passed':
    case 'course':
      return model;
    // A new attempt: drop the notice of the last one.
    case 'sent':
      return withoutNotice(model, input.place);
    case 'answer':
      return input.place && input.answer.type === 'refused'
        ? withError(model, input.place, refusalWords(input.answer))
        : model;
    case 'notice':
      return withNotice(model, input.place, 'hint', input.text);
    case 'dismiss':
      return model.notices[input.place]?.id === input.id
        ? withoutNotice(model, input.place)
        : model;
  }
}

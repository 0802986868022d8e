// Connection → model → one animation frame → panels. Everything a panel may see or do is in `Lab`.

import { batch, createMemo, createSignal, type Accessor } from 'solid-js';
import { openPage } from '../net/access';
import { connect, liveAddress, type Picture } from '../net/connection';
import { createEdits, type Edits } from './edits';
import { createGhosts, type Ghosts } from './comparison';
import { History } from './history';
import { EMPTY, type Input, type Model, type Place, reduce } from './model';
import {
  BINARY_CAMERA_JPEG,
  BINARY_OBSERVATION,
  type ClientMessage,
  type EventMessage,
  type Parameters,
} from '../net/protocol.gen';
import { sessionOf } from '../net/session';
import { createGoal } from './goal';
import type { Vec2 } from './geometry';
import { createLayerChoice, type KnownLayer, type Layers } from './layers';

export interface Lab extends Layers {
  /** Whose page this is. */
  readonly session: string;
  readonly link: Accessor<Model['link']>;
  readonly hello: Accessor<Model['hello']>;
  readonly scene: Accessor<Model['scene']>;
  /** The parameters in force, with what some panel is about to change on top. */
  readonly tuning: Accessor<Parameters | undefined>;
  readonly state: Accessor<Model['state']>;
  readonly goal: Accessor<Vec2 | undefined>;
  readonly overlay: Accessor<Model['overlay']>;
  readonly seen: Accessor<Model['seen']>;
  readonly log: Accessor<Model['log']>;
  readonly marks: Accessor<Model['marks']>;
  readonly ghosts: Ghosts;
  /** The event whose story is open. */
  readonly inspected: Accessor<EventMessage | undefined>;
  /** The tab that was asked to open last, wherever it is. */
  readonly opened: Accessor<{ readonly tab: string } | undefined>;
  readonly notices: Accessor<Model['notices']>;
  readonly refusals: Accessor<number>;
  readonly silences: Accessor<number>;
  readonly camera: Accessor<Picture | undefined>;
  readonly observation: Accessor<Picture | undefined>;
  /** Why the session ended, if it has. */
  readonly ended: Accessor<string | undefined>;
  /** Connected to a session that goes on, and its operator. */
  readonly canOperate: Accessor<boolean>;
  readonly history: History;
  /** Changes of the parameters, from whichever panel. */
  readonly edits: Edits;
  send(message: ClientMessage): void;
  inspect(event: EventMessage | undefined): void;
  openTab(tab: string | undefined): void;
  notify(place: Place, text: string): void;
  dismiss(place: Place, id: number): void;
}

/** Where another operates, that one is asked. */
export function takeControl(lab: Lab): void {
  lab.send({ type: 'take_control' });
  if (lab.hello()?.operator_present) {
    lab.notify('session', 'Asked: the operator has to release control.');
  }
}

const HIDDEN_FLUSH_MS = 250;

/** Calls `work` before the next frame, or soon when the page is hidden and draws none. */
function frameScheduler(work: () => void): () => void {
  let cancel: (() => void) | undefined;
  const run = (): void => {
    cancel = undefined;
    work();
  };
  document.addEventListener('visibilitychange', () => {
    if (!cancel) return;
    cancel();
    run();
  });
  return () => {
    if (cancel) return;
    if (document.hidden) {
      const id = setTimeout(run, HIDDEN_FLUSH_MS);
      cancel = () => {
        clearTimeout(id);
      };
    } else {
      const id = requestAnimationFrame(run);
      cancel = () => {
        cancelAnimationFrame(id);
      };
    }
  };
}

/** Drops what `input` supersedes: of states, overlays and what was seen only the newest is worth drawing. */
export function enqueue(queue: Input[], input: Input): void {
  if (input.type === 'message') {
    const kind = input.message.type;
    if (kind === 'state' || kind === 'overlay' || kind === 'seen') {
      const old = queue.findIndex((item) => item.type === 'message' && item.message.type === kind);
      if (old >= 0) queue.splice(old, 1);
    }
  }
  queue.push(input);
}

export function createLab(page: Location, knownLayers: readonly KnownLayer[]): Lab {
  const [model, setModel] = createSignal<Model>(EMPTY);
  const [camera, setCamera] = createSignal<Picture>();
  const [observation, setObservation] = createSignal<Picture>();
  const [inspected, inspect] = createSignal<EventMessage>();
  const [opened, setOpened] = createSignal<{ readonly tab: string }>();
  const history = new History();
  let queue: Input[] = [];
  const pictures = new Map<number, Picture>();

  const remember = (before: Model, after: Model): void => {
    if (before.scene && before.scene.trial !== after.scene?.trial) {
      history.clear();
      inspect(undefined);
    }
    if (!after.state || after.state === before.state) return;
    if (before.state && after.state.newest_tick < before.state.newest_tick) {
      // Down to the moment itself, which a reset may have changed.
      history.cutAfter(after.state.newest_tick - 1);
    }
    history.push(after.state);
  };

  const flush = (): void => {
    const inputs = queue;
    queue = [];
    const before = model();
    const after = inputs.reduce(reduce, before);
    remember(before, after);
    batch(() => {
      setModel(after);
      const newCamera = pictures.get(BINARY_CAMERA_JPEG);
      if (newCamera) setCamera(newCamera);
      const newObservation = pictures.get(BINARY_OBSERVATION);
      if (newObservation) setObservation(newObservation);
      pictures.clear();
    });
  };
  const schedule = frameScheduler(flush);
  const take = (input: Input): void => {
    enqueue(queue, input);
    schedule();
  };

  const session = sessionOf(page);
  const line = {
    address: liveAddress(page, session),
    // Its page asked for would begin it anew: that is for a person to decide.
    isOver: () => ended() !== undefined,
    reopen: () => openPage(page.pathname),
  };
  const connection = connect(line, {
    opened: () => {
      take({ type: 'link', link: { kind: 'live' } });
    },
    lost: (attempt) => {
      take({ type: 'link', link: { kind: 'lost', attempt } });
    },
    refused: (why) => {
      take({ type: 'notice', place: 'session', text: why });
    },
    message: (message) => {
      take({ type: 'message', message });
    },
    picture: (picture) => {
      pictures.set(picture.kind, picture);
      schedule();
    },
  });

  const link = createMemo(() => model().link);
  const hello = createMemo(() => model().hello);
  const scene = createMemo(() => model().scene);
  const state = createMemo(() => model().state);
  const ended = createMemo(() => model().state?.ended ?? undefined);
  const refusals = createMemo(() => model().refusals);
  const canOperate = createMemo(
    () => link().kind === 'live' && hello()?.role === 'operator' && ended() === undefined,
  );
  const send = (message: ClientMessage): void => {
    // `release` is sent blindly when a hold ends; a lost socket has released it already.
    if (connection.send(message)) take({ type: 'sent', command: message.type });
    if (message.type === 'fork') ghosts.show();
  };
  const ghosts = createGhosts(
    createMemo(() => model().comparison),
    () => scene()?.tick_s ?? Infinity,
  );
  const edits = createEdits({ scene, refusals, canOperate, send });
  return {
    session,
    link,
    hello,
    scene,
    tuning: edits.shown,
    state,
    goal: createGoal(state),
    overlay: createMemo(() => model().overlay),
    seen: createMemo(() => model().seen),
    log: createMemo(() => model().log),
    marks: createMemo(() => model().marks),
    ghosts,
    inspected,
    opened,
    notices: createMemo(() => model().notices),
    refusals,
    silences: createMemo(() => model().silences),
    camera,
    observation,
    ended,
    canOperate,
    history,
    edits,
    send,
    ...createLayerChoice(knownLayers),
    inspect: (event) => {
      inspect(event);
    },
    openTab: (tab) => {
      setOpened(tab === undefined ? undefined : { tab });
    },
    notify: (place, text) => {
      take({ type: 'notice', place, text });
    },
    dismiss: (place, id) => {
      take({ type: 'dismiss', place, id });
    },
  };
}

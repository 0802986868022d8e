// Assembles the slices: connection → model → one animation frame → panels.

import { batch, createEffect, createMemo, createSignal } from 'solid-js';
import { openPage } from '../net/access';
import { connect, liveAddress, type Picture } from '../net/connection';
import {
  BINARY_CAMERA_JPEG,
  BINARY_OBSERVATION,
  type ClientMessage,
  type EventMessage,
  type ServerMessage,
} from '../net/protocol.gen';
import { sessionOf } from '../net/session';
import { type Answer, Commands, type Streamed } from './commands';
import { createAddress } from './address';
import { createCatalog } from './catalog';
import { createComparison } from './comparison';
import { createContest } from './contest';
import { createEdits } from './edits';
import { createGoal } from './goal';
import { History } from './history';
import { frameScheduler, Inbox } from './inbox';
import { createKeeper } from './keepControl';
import { createLayerChoice, type KnownLayer } from './layers';
import { EMPTY, type Input, type Model, reduce } from './model';
import type { Place } from './places';
import type { Sight } from './sight';
import type { Lab } from './slices';
import { createSteering } from './steering';
import { createWalls } from './walls';
import { tabStorage } from '../ui/storage';
import { pathOf } from '../net/base';

type AnswerMessage = Extract<ServerMessage, { type: 'done' | 'refused' }>;

const isAnswer = (message: ServerMessage): message is AnswerMessage =>
  message.type === 'done' || message.type === 'refused';

export function createLab(page: Window, knownLayers: readonly KnownLayer[]): Lab {
  const [model, setModel] = createSignal<Model>(EMPTY);
  const [camera, setCamera] = createSignal<Picture>();
  const [observation, setObservation] = createSignal<Picture>();
  const [inspected, setInspected] = createSignal<EventMessage>();
  const [opened, setOpened] = createSignal<{ readonly tab: string }>();
  const history = new History();
  const inbox = new Inbox();
  const pictures = new Map<number, Picture>();

  const remember = (before: Model, after: Model): void => {
    if (before.scene && before.scene.trial !== after.scene?.trial) {
      history.clear();
      setInspected(undefined);
    }
    if (!after.state || after.state === before.state) return;
    if (before.state && after.state.newest_tick < before.state.newest_tick) {
      // Down to the moment itself, which a reset may have changed.
      history.cutAfter(after.state.newest_tick - 1);
    }
    history.push(after.state);
  };

  const flush = (): void => {
    const before = model();
    const inputs = inbox.take();
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
    // What they answer is shown now.
    for (const input of inputs) {
      if (input.type === 'connection') {
        if (input.connection.kind !== 'live') commands.lose();
      } else if (input.type === 'message' && isAnswer(input.message)) {
        commands.answer(input.message);
      }
    }
    if (!inbox.isEmpty) schedule();
  };
  const schedule = frameScheduler(flush);
  const take = (input: Input): void => {
    inbox.add(input);
    schedule();
  };

  const { location } = page;
  const name = sessionOf(location);
  const keeper = createKeeper(
    name,
    tabStorage(),
    () => void send('session', { type: 'take_control' }),
  );
  const socket = connect(
    {
      address: () => liveAddress(location, name, keeper.seat()),
      // Requesting its page again would restart it: the user decides that.
      isOver: () => ended() !== undefined,
      reopen: () => openPage(pathOf(location.pathname)),
    },
    {
      opened: () => {
        keeper.opened();
        take({ type: 'connection', connection: { kind: 'live' } });
      },
      lost: (attempt) => {
        take({ type: 'connection', connection: { kind: 'lost', attempt } });
      },
      refused: (why) => {
        take({ type: 'notice', place: 'session', text: why });
      },
      message: (message) => {
        if (message.type === 'hello') keeper.hello(message);
        if (message.type === 'refused') {
          const place = commands.placeOf(message.id);
          if (place) take({ type: 'refused', place, refusal: message });
        }
        if (!feed.take(message)) take({ type: 'message', message });
      },
      picture: (picture) => {
        pictures.set(picture.kind, picture);
        schedule();
      },
    },
  );

  const commands = new Commands((message) => socket.send(message));

  const part = <K extends keyof Model>(key: K) => createMemo(() => model()[key]);
  const connection = part('connection');
  const hello = part('hello');
  const scene = part('scene');
  const state = part('state');
  const ended = createMemo(() => state()?.ended ?? undefined);
  const canOperate = createMemo(
    () => connection().kind === 'live' && hello()?.role === 'operator' && ended() === undefined,
  );
  // A refusal needs no notice: the training is gone, and so it is from the list.
  const feed = createCatalog(connection, (training) => {
    socket.send({ type: 'watch_training', training, id: 0 });
  });
  const send = (at: Place, message: ClientMessage): Promise<Answer> => {
    take({ type: 'sent', place: at });
    if (message.type === 'fork') comparison.show();
    return commands.send(at, message);
  };
  // Sent blindly: a lost connection has released the bead already.
  const stream = (message: Streamed): void => {
    socket.send(message);
  };
  const comparison = createComparison(part('comparison'), () => scene()?.tick_s ?? Infinity);
  const [sight, setSight] = createSignal<Sight>('all');
  const steering = createSteering({ scene, state, canOperate, stream });
  // The choice belongs to the controller You: with another one, the page has no way back.
  createEffect(() => {
    if (state()?.controller !== 'you') setSight('all');
  });
  const notify: Lab['notify'] = (place, text) => {
    take({ type: 'notice', place, text });
  };
  const edits = createEdits({ scene, canOperate, send });
  return {
    session: name,
    address: createAddress(page),
    connection,
    hello,
    ended,
    canOperate,
    isReturning: () => keeper.isReturning(),
    send,
    stream,
    catalog: feed.catalog,
    scene,
    state,
    goal: createGoal(state),
    history,
    tuning: edits.shown,
    edits,
    silences: part('silences'),
    log: part('log'),
    marks: part('marks'),
    inspected,
    inspect: setInspected,
    notices: part('notices'),
    notify,
    dismiss: (place, id) => {
      take({ type: 'dismiss', place, id });
    },
    camera,
    observation,
    overlay: part('overlay'),
    obstacleMap: part('obstacleMap'),
    movedWalls: createWalls({ session: name, connection, scene, state, notify }),
    steering,
    contest: createContest({ session: name, hello, scene, state, send }),
    sight,
    setSight,
    comparison,
    ...createLayerChoice(knownLayers),
    opened,
    openTab: (tab) => {
      setOpened(tab === undefined ? undefined : { tab });
    },
  };
}

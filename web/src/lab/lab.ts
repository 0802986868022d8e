// Assembles the slices: connection → model → one animation frame → panels.

import { batch, createEffect, createMemo, createSignal } from 'solid-js';
import { openPage } from '../net/access';
import { connect, liveAddress, type Picture } from '../net/connection';
import {
  BINARY_CAMERA_JPEG,
  BINARY_COURSE,
  BINARY_OBSERVATION,
  type ClientMessage,
  type EventMessage,
} from '../net/protocol.gen';
import { sessionOf } from '../net/session';
import { createAddress } from './address';
import type { Basis } from './basis';
import { type Answer, Commands } from './commands';
import { createCatalog } from './catalog';
import { createComparison } from './comparison';
import { createContest } from './contest';
import { createRecorder } from './course';
import { createEdits } from './edits';
import { createGoal } from './goal';
import { History } from './history';
import { frameScheduler, Inbox } from './inbox';
import { createKeeper } from './keepControl';
import { createLayerChoice, type KnownLayer } from './layers';
import { EMPTY, type Input, type Model, reduce } from './model';
import { createPanels } from './panels';
import type { Place } from './places';
import type { Sight } from './sight';
import type { Lab } from './slices';
import { createSteering } from './steering';
import { createWalls } from './walls';
import { tabStorage } from '../ui/storage';
import { pathOf } from '../net/base';

export function createLab(page: Window, knownLayers: readonly KnownLayer[]): Lab {
  const [model, setModel] = createSignal<Model>(EMPTY);
  const [camera, setCamera] = createSignal<Picture>();
  const [observation, setObservation] = createSignal<Picture>();
  const [inspected, setInspected] = createSignal<EventMessage>();
  const history = new History();
  const inbox = new Inbox();
  const pictures = new Map<number, Picture>();

  const record = createRecorder(history);

  const flush = (): void => {
    const before = model();
    const inputs = inbox.take();
    const after = inputs.reduce(reduce, before);
    inputs.forEach(record);
    batch(() => {
      if (before.scene && before.scene.trial !== after.scene?.trial) setInspected(undefined);
      setModel(after);
      setCamera((before) => pictures.get(BINARY_CAMERA_JPEG) ?? before);
      setObservation((before) => pictures.get(BINARY_OBSERVATION) ?? before);
      pictures.clear();
    });
    // What they answer is shown now.
    for (const input of inputs) {
      if (input.type === 'connection' && input.connection.kind !== 'live') commands.lose();
      else if (input.type === 'answer') commands.answer(input.answer);
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
  const keeper = createKeeper(name, tabStorage());
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
      lost: (attempt) => take({ type: 'connection', connection: { kind: 'lost', attempt } }),
      refused: (why) => take({ type: 'notice', place: 'session', text: why }),
      message: (message) => {
        switch (message.type) {
          case 'done':
          case 'refused':
            take({ type: 'answer', place: commands.placeOf(message.id), answer: message });
            break;
          case 'catalog':
          case 'training_points':
            feed.take(message);
            break;
          default:
            if (message.type === 'hello') keeper.hello(message);
            take({ type: 'message', message });
        }
      },
      picture: (picture) => {
        if (picture.kind === BINARY_COURSE) {
          take({ type: 'course', part: picture });
          return;
        }
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
  const feed = createCatalog(connection, (training) =>
    socket.send({ type: 'watch_training', training, id: 0 }),
  );
  const send = (at: Place, message: ClientMessage): Promise<Answer> => {
    take({ type: 'sent', place: at });
    if (message.type === 'fork') comparison.show();
    return commands.send(at, message);
  };
  const basis: Basis = {
    session: name,
    connection,
    hello,
    scene,
    state,
    canOperate,
    send,
    // Sent blindly: a lost connection has released the bead already.
    stream: (message) => socket.send(message),
    notify: (place, text) => take({ type: 'notice', place, text }),
  };
  const comparison = createComparison(part('comparison'), () => scene()?.tick_s ?? Infinity);
  const [sight, setSight] = createSignal<Sight>('all');
  // The choice belongs to the controller You: with another one, the page has no way back.
  createEffect(() => {
    if (state()?.controller !== 'you') setSight('all');
  });
  const panels = createPanels();
  return {
    ...basis,
    address: createAddress(page),
    ended,
    isReturning: () => keeper.isReturning(),
    catalog: feed.catalog,
    goal: createGoal(state),
    history,
    edits: createEdits(basis),
    silences: part('silences'),
    log: part('log'),
    marks: part('marks'),
    inspected,
    inspect: (event) => {
      setInspected(event);
      if (event) panels.showPanel('story');
    },
    notices: part('notices'),
    dismiss: (place, id) => take({ type: 'dismiss', place, id }),
    camera,
    observation,
    overlay: part('overlay'),
    obstacleMap: part('obstacleMap'),
    movedWalls: createWalls(basis),
    steering: createSteering(basis),
    contest: createContest(basis),
    sight,
    setSight,
    comparison,
    ...createLayerChoice(knownLayers),
    ...panels,
  };
}

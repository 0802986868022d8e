// One training as it happens: the messages of its WebSocket, and its cells and value maps.

import { createEffect, createMemo, createSignal, on, onCleanup, type Accessor } from 'solid-js';
import { backoffMs, socketAddress } from '../../net/connection';
import type {
  TrainingCells,
  TrainingFrame,
  TrainingMessage,
  TrainingPoint,
  TrainingSummary,
} from '../../net/protocol.gen';
import { get } from '../../net/requests';
import { FrameCache } from './frames';
import { isActive } from '../../lab/trainingStage';
import { trainingPath } from './trainings';

export interface Followed {
  readonly summary: TrainingSummary;
  readonly points: readonly TrainingPoint[];
}

/** Adds a message. The first one of a connection has all points. */
export function follow(
  before: Followed | undefined,
  { summary, points }: TrainingMessage,
  isFirst: boolean,
): Followed {
  if (isFirst || !before) return { summary, points };
  return { summary, points: points.length === 0 ? before.points : [...before.points, ...points] };
}

/** Follows the training with this id until the returned function is called. */
function watch(
  id: string,
  onMessage: (message: TrainingMessage, isFirst: boolean) => void,
  onLost: (isLost: boolean) => void,
): () => void {
  let socket: WebSocket | undefined;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let attempt = 0;
  let isOver = false;
  const open = (): void => {
    let isFirst = true;
    socket = new WebSocket(socketAddress(window.location, `${trainingPath(id)}/live`));
    socket.onmessage = ({ data }: MessageEvent<string>) => {
      const message = JSON.parse(data) as TrainingMessage;
      attempt = 0;
      onLost(false);
      onMessage(message, isFirst);
      isFirst = false;
      isOver = !isActive(message.summary);
    };
    // An error is always followed by a close.
    socket.onclose = () => {
      if (isOver) return;
      attempt += 1;
      onLost(true);
      timer = setTimeout(open, backoffMs(attempt, Math.random()));
    };
  };
  open();
  return () => {
    isOver = true;
    clearTimeout(timer);
    socket?.close();
  };
}

export interface Live {
  readonly summary: Accessor<TrainingSummary>;
  readonly points: Accessor<readonly TrainingPoint[]>;
  /** Whether the connection is lost. */
  readonly isLost: Accessor<boolean>;
  readonly cells: Accessor<TrainingCells | undefined>;
  /** Why cells or value maps are missing, if something went wrong. */
  readonly error: Accessor<string | undefined>;
  /** A value map, read if necessary. */
  frame(index: number): TrainingFrame | undefined;
  /** All value maps that have been read. */
  readonly frames: Accessor<readonly TrainingFrame[]>;
  /** Reads all value maps, also those to come. */
  readAll(): void;
}

/** `listed` is the training in the list; its id stays the same. */
export function createLive(listed: Accessor<TrainingSummary>): Live {
  const { id } = listed();
  const [followed, setFollowed] = createSignal<Followed>();
  const [isLost, setLost] = createSignal(false);
  const [cells, setCells] = createSignal<TrainingCells>();
  const [error, setError] = createSignal<string>();
  const [version, setVersion] = createSignal(0);
  const [isReadingAll, setReadingAll] = createSignal(false);
  const path = trainingPath(id);
  const cache = new FrameCache((index) => get<TrainingFrame>(`${path}/frames/${index}`), {
    changed: () => setVersion((before) => before + 1),
    failed: setError,
  });
  const unwatch = watch(
    id,
    (message, isFirst) => {
      setFollowed((before) => follow(before, message, isFirst));
    },
    setLost,
  );
  const summary = createMemo(() => (isLost() ? listed() : (followed()?.summary ?? listed())));
  const stage = createMemo(() => summary().stage);
  const count = createMemo(() => summary().frames);
  let isAsking = false;
  createEffect(
    on([stage, count], async ([now]) => {
      if (cells() || isAsking || now === 'waiting' || now === 'images') return;
      isAsking = true;
      try {
        setCells(await get<TrainingCells>(`${path}/cells`));
        setError(undefined);
      } catch (reason) {
        // A training that was cancelled early has none.
        if (isActive(summary()))
          setError(reason instanceof Error ? reason.message : String(reason));
      }
      isAsking = false;
    }),
  );
  createEffect(() => {
    version();
    if (isReadingAll()) cache.wantAll(count());
  });
  onCleanup(() => {
    unwatch();
    cache.close();
  });
  const frames = createMemo(() => {
    version();
    return cache.all();
  });
  return {
    summary,
    points: () => followed()?.points ?? [],
    isLost,
    cells,
    error,
    frame: (index) => {
      version();
      const found = cache.get(index);
      if (!found && index >= 0 && index < count()) cache.want(index);
      return found;
    },
    frames,
    readAll: () => {
      setReadingAll(true);
    },
  };
}

// One training as it happens: its points, its cells and its value maps.

import { createEffect, createMemo, createSignal, on, onCleanup, type Accessor } from 'solid-js';
import { createDetail } from '../../net/detail';
import type {
  TrainingCells,
  TrainingFrame,
  TrainingPoint,
  TrainingReport,
  TrainingSummary,
} from '../../net/protocol.gen';
import { get } from '../../net/requests';
import { messageOf } from '../../ui/attempt';
import { FrameCache } from './frames';
import { isActive } from '../../lab/trainingStage';
import { TRAININGS, trainingPath } from './trainings';

export interface Live {
  readonly summary: Accessor<TrainingSummary>;
  readonly points: Accessor<readonly TrainingPoint[]>;
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

/** The id of the training stays the same. `watched` are its points while the server sends them. */
export function createLive(
  summary: Accessor<TrainingSummary>,
  watched: Accessor<readonly TrainingPoint[] | undefined>,
): Live {
  const [cells, setCells] = createSignal<TrainingCells>();
  const [error, setError] = createSignal<string>();
  const [version, setVersion] = createSignal(0);
  const [isReadingAll, setReadingAll] = createSignal(false);
  const path = trainingPath(summary().id);
  const report = createDetail<TrainingSummary, TrainingReport>(
    TRAININGS,
    () => (watched() ? undefined : summary()),
    ({ stage, updates }) => `${stage} ${updates}`,
  );
  const cache = new FrameCache((index) => get<TrainingFrame>(`${path}/frames/${index}`), {
    changed: () => setVersion((before) => before + 1),
    failed: setError,
  });
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
        if (isActive(summary())) setError(messageOf(reason));
      }
      isAsking = false;
    }),
  );
  createEffect(() => {
    version();
    if (isReadingAll()) cache.wantAll(count());
  });
  onCleanup(() => {
    cache.close();
  });
  const frames = createMemo(() => {
    version();
    return cache.all();
  });
  return {
    summary,
    points: () => watched() ?? report()?.curve ?? [],
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

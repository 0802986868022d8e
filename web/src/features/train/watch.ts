// A training that is watched: which of its value maps is shown, and its cell at the chosen place.

import { createEffect, createMemo, createSignal, onCleanup, type Accessor } from 'solid-js';
import { checkOfMap } from '../../lab/maps';
import { isActive } from '../../lab/trainingStage';
import type { MapCheck, TrainingFrame, TrainingSummary } from '../../net/protocol.gen';
import { createAttempt } from '../../ui/attempt';
import { counted } from '../../ui/format';
import { cellAt } from './grid';
import { place_m } from './state';
import { coarseToFine, createValueMaps } from './valueMaps';

const PLAY_MS = 350;

/** The id of the training stays the same. */
export function createWatch(summary: Accessor<TrainingSummary>) {
  const [map, setMap] = createSignal<MapCheck>();
  const walls = createAttempt();
  void walls.attempt(checkOfMap(summary().query.map).then(setMap));
  /** Index of the shown value map; undefined: the newest. */
  const [at, setAt] = createSignal<number>();
  const [isPlaying, setPlaying] = createSignal(false);
  const count = createMemo(() => summary().frames);
  const last = (): number => Math.max(0, count() - 1);
  const index = createMemo(() => Math.min(at() ?? last(), last()));
  const maps = createValueMaps(
    summary,
    // All of them for the fan of a cell.
    () =>
      [index(), ...(cell() === undefined ? [] : coarseToFine(count()))].filter(
        (one) => one < count(),
      ),
  );
  const cell = createMemo(() => {
    const [cells, place] = [maps.cells(), place_m()];
    return cells && place && cellAt(cells, place);
  });
  // The one before stays until the next one has arrived.
  const frame = createMemo<TrainingFrame | undefined>((before) => maps.frames()[index()] ?? before);
  createEffect(() => {
    if (!isPlaying()) return;
    const timer = setInterval(() => {
      // A value map that is slow to arrive is waited for.
      if (maps.frames()[index()] === undefined) return;
      if (index() < last()) setAt(index() + 1);
      else show(undefined);
    }, PLAY_MS);
    onCleanup(() => clearInterval(timer));
  });
  /** Undefined: follows the newest. */
  const show = (next: number | undefined): void => {
    setPlaying(false);
    setAt(next);
  };
  return {
    summary,
    count,
    last,
    index,
    cell,
    frame,
    cells: maps.cells,
    /** Its walls and its size. */
    map,
    error: (): string | undefined => maps.error() ?? walls.refusal(),
    /** All value maps that have been read. */
    read: createMemo(() => maps.frames().filter((one) => one !== undefined)),
    isPlaying,
    isNewest: (): boolean => at() === undefined,
    show,
    playOrStop: (): void => {
      if (!isPlaying() && index() === last()) setAt(0);
      setPlaying(!isPlaying());
    },
    words: (): string => {
      const now = frame();
      if (now) return `after ${counted(now.update, 'update')}`;
      return isActive(summary()) ? 'no value map yet' : '–';
    },
  };
}

export type Watch = ReturnType<typeof createWatch>;

// The cells of a training and its value maps, read one after the other and kept: they never change.

import {
  createEffect,
  createMemo,
  createSignal,
  onCleanup,
  untrack,
  type Accessor,
} from 'solid-js';
import { isActive } from '../../lab/trainingStage';
import type { TrainingCells, TrainingFrame, TrainingSummary } from '../../net/protocol.gen';
import { get } from '../../net/requests';
import { messageOf } from '../../ui/attempt';
import { trainingPath } from './trainings';

/** After a failed request. */
const PAUSE_MS = 2000;
/** Distance of the first value maps of a fan; then those between. */
const FIRST_STRIDE = 16;

/** The order in which to read `count` value maps: coarse first, so that a fan over time has its shape early. */
export function coarseToFine(count: number): number[] {
  const order = new Set<number>();
  if (count > 0) order.add(count - 1);
  for (let stride = FIRST_STRIDE; stride >= 1; stride /= 2) {
    for (let index = 0; index < count; index += stride) order.add(index);
  }
  return [...order];
}

/** `wanted` are the value maps to read, by their index, the first one first. The id of the training stays the same. */
export function createValueMaps(
  summary: Accessor<TrainingSummary>,
  wanted: (cells: TrainingCells) => readonly number[],
  load: <A>(path: string) => Promise<A> = get,
) {
  const [cells, setCells] = createSignal<TrainingCells>();
  /** By their index; undefined where one was not read. */
  const [frames, setFrames] = createSignal<readonly (TrainingFrame | undefined)[]>([]);
  /** Why the last request failed; undefined if it did not. */
  const [error, setError] = createSignal<string>();
  const path = trainingPath(summary().id);
  const hasCells = (): boolean => {
    const { stage, frames } = summary();
    return frames > 0 || (isActive({ stage }) && stage !== 'waiting' && stage !== 'images');
  };
  const next = createMemo((): 'cells' | number | undefined => {
    const now = cells();
    if (!now) return hasCells() ? 'cells' : undefined;
    return wanted(now).find((index) => !frames()[index]);
  });
  const read = async (what: 'cells' | number): Promise<void> => {
    if (what === 'cells') setCells(await load<TrainingCells>(`${path}/cells`));
    else {
      const frame = await load<TrainingFrame>(`${path}/frames/${what}`);
      setFrames((before) => {
        const after = [...before];
        after[what] = frame;
        return after;
      });
    }
  };
  let isReading = false;
  let isClosed = false;
  const readOn = async (): Promise<void> => {
    if (isReading) return;
    isReading = true;
    for (let what = next(); what !== undefined && !isClosed; what = next()) {
      try {
        await read(what);
        setError(undefined);
      } catch (reason) {
        setError(messageOf(reason));
        await new Promise((done) => setTimeout(done, PAUSE_MS));
      }
    }
    isReading = false;
  };
  createEffect(() => {
    if (next() !== undefined) void untrack(readOn);
  });
  onCleanup(() => {
    isClosed = true;
  });
  return { cells, frames, error };
}

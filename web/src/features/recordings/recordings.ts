// The list of recordings, polled while the session's own recording grows, changes to it, and the text of its entries.

import { createEffect, createSignal, on, onCleanup, type Accessor } from 'solid-js';
import { get, patch, remove } from '../../net/requests';
import type { RecordingFile, RecordingList, RecordingTitle } from '../../net/protocol.gen';
import { messageOf } from '../../ui/attempt';

const REFRESH_MS = 3000;

/** `7.0 kB`, `12.3 MB`: three digits at most, in powers of ten. */
export function size(bytes: number): string {
  const units = ['kB', 'MB', 'GB', 'TB'];
  let value = bytes / 1000;
  let unit = 0;
  // 999.5 would be shown as 1000.
  while (value >= 999.5 && unit < units.length - 1) {
    value /= 1000;
    unit += 1;
  }
  return `${value.toFixed(value < 99.95 ? 1 : 0)} ${units[unit] ?? ''}`;
}

/** Local time with seconds: two sessions may start within one minute. */
export function startedAt(started: string, locale?: string, timeZone?: string) {
  const date = new Date(started);
  const zone = timeZone === undefined ? {} : { timeZone };
  return {
    day: date.toLocaleDateString(locale, { dateStyle: 'medium', ...zone }),
    time: date.toLocaleTimeString(locale, { timeStyle: 'medium', ...zone }),
  };
}

/** Session and beginning, which identify a recording. */
export function label({ id, session, started }: RecordingFile): string {
  if (session === null || started === null) return id;
  const { day, time } = startedAt(started);
  return `${session}, ${day}, ${time}`;
}

/** Rerun's file for the viewer, and the input log for `ferry replay`. */
export type Ending = 'rrd' | 'ferry';

const recordingPath = (id: string): string => `/api/recordings/${encodeURIComponent(id)}`;

export const filePath = (id: string, ending: Ending): string => `${recordingPath(id)}.${ending}`;

/** The list, read again when the page is shown, and while `moved` changes, which is what the session records. */
export function createRecordings(moved: Accessor<unknown>) {
  /** Undefined before the first answer. */
  const [list, setList] = createSignal<readonly RecordingFile[]>();
  /** Why the last request failed. */
  const [error, setError] = createSignal<string>();
  let asking = false;
  let closed = false;
  let changes = 0;
  const ask = async (): Promise<void> => {
    if (asking) return;
    asking = true;
    const before = changes;
    try {
      const { recordings } = await get<RecordingList>('/api/recordings');
      // The list may be older than a change.
      if (closed || before !== changes) return;
      setList(recordings);
      setError(undefined);
    } catch (reason) {
      if (!closed) setError(messageOf(reason));
    } finally {
      asking = false;
    }
  };
  const refresh = (): void => void ask();
  const change = (to: (list: readonly RecordingFile[]) => readonly RecordingFile[]): void => {
    changes += 1;
    if (!closed) setList((list) => list && to(list));
  };
  /** Gives a recording a title; an empty one removes it. A refusal is thrown, here and below. */
  const rename = async (id: string, title: string): Promise<void> => {
    const body: RecordingTitle = { title };
    const renamed = await patch<RecordingFile>(recordingPath(id), JSON.stringify(body));
    change((list) => list.map((file) => (file.id === id ? renamed : file)));
  };
  const discard = async (id: string): Promise<void> => {
    await remove(recordingPath(id));
    change((list) => list.filter((file) => file.id !== id));
  };
  const whileVisible = (): void => {
    if (document.visibilityState === 'visible') refresh();
  };
  // The server writes about a second later what was recorded: the list is read once more than it has changed.
  let left = 1;
  createEffect(on(moved, () => (left = 2), { defer: true }));
  refresh();
  const timer = setInterval(() => {
    if (left === 0) return;
    left -= 1;
    whileVisible();
  }, REFRESH_MS);
  document.addEventListener('visibilitychange', whileVisible);
  onCleanup(() => {
    closed = true;
    clearInterval(timer);
    document.removeEventListener('visibilitychange', whileVisible);
  });
  return { list, error, refresh, rename, discard };
}

// A resource of the server that is read again and again.

import { createSignal, onCleanup, type Accessor } from 'solid-js';
import { get } from './requests';

export interface Poll<A> {
  /** The newest answer; undefined before the first one. */
  readonly data: Accessor<A | undefined>;
  /** Why it is out of date, if it is. */
  readonly error: Accessor<string | undefined>;
  /** Reads it now. */
  readonly refresh: () => Promise<void>;
}

/**
 * Reads `path` until the owner is disposed of, with a pause that may depend on the newest answer, and on the reason why
 * the last request has none.
 */
export function createPoll<A>(
  path: string,
  pauseMs: (newest: A | undefined, reason?: unknown) => number,
): Poll<A> {
  const [data, setData] = createSignal<A>();
  const [error, setError] = createSignal<string>();
  let timer: ReturnType<typeof setTimeout> | undefined;
  let requests = 0;
  let isClosed = false;
  const refresh = async (): Promise<void> => {
    clearTimeout(timer);
    if (isClosed) return;
    requests += 1;
    const number = requests;
    let failure: unknown;
    try {
      const answer = await get<A>(path);
      if (number !== requests) return;
      setData(() => answer);
      setError(undefined);
    } catch (reason) {
      if (number !== requests) return;
      failure = reason;
      setError(reason instanceof Error ? reason.message : String(reason));
    }
    timer = setTimeout(() => void refresh(), pauseMs(data(), failure));
  };
  void refresh();
  onCleanup(() => {
    clearTimeout(timer);
    // A pending answer is ignored.
    requests += 1;
    isClosed = true;
  });
  return { data, error, refresh };
}

// A resource of the server that is read again and again: the page has no session, whose connection would bring it.

import { createSignal, onCleanup, type Accessor } from 'solid-js';
import { get } from '../../net/requests';

export interface Poll<A> {
  /** The newest answer; undefined before the first one. */
  readonly data: Accessor<A | undefined>;
  /** Why it is out of date, if it is. */
  readonly error: Accessor<string | undefined>;
}

/** Reads `path` until the owner is disposed of, with a pause that may depend on why the last request has no answer. */
export function createPoll<A>(path: string, pauseMs: (reason?: unknown) => number): Poll<A> {
  const [data, setData] = createSignal<A>();
  const [error, setError] = createSignal<string>();
  let timer: ReturnType<typeof setTimeout> | undefined;
  let isClosed = false;
  const read = async (): Promise<void> => {
    let failure: unknown;
    try {
      const answer = await get<A>(path);
      if (isClosed) return;
      setData(() => answer);
      setError(undefined);
    } catch (reason) {
      failure = reason;
      setError(reason instanceof Error ? reason.message : String(reason));
    }
    if (!isClosed) timer = setTimeout(() => void read(), pauseMs(failure));
  };
  void read();
  onCleanup(() => {
    clearTimeout(timer);
    isClosed = true;
  });
  return { data, error };
}

// A resource of the server that is read again and again: the page has no session, whose connection would bring it.

import { createSignal, onCleanup } from 'solid-js';
import { get, Refusal } from '../../net/requests';
import { reasonText } from '../../net/problem';

const NOT_FOUND = 404;

/** Reads `path` until the owner is disposed of. A wrong name stays wrong, and is not read again. */
export function createPoll<A>(path: string, pause_ms: number) {
  const [data, setData] = createSignal<A>();
  const [error, setError] = createSignal<string>();
  let timer: ReturnType<typeof setTimeout> | undefined;
  let isClosed = false;
  const read = async (): Promise<void> => {
    try {
      const answer = await get<A>(path);
      if (isClosed) return;
      setData(() => answer);
      setError(undefined);
    } catch (reason) {
      setError(reasonText(reason));
      if (reason instanceof Refusal && reason.status === NOT_FOUND) return;
    }
    if (!isClosed) timer = setTimeout(() => void read(), pause_ms);
  };
  void read();
  onCleanup(() => {
    clearTimeout(timer);
    isClosed = true;
  });
  return {
    /** The newest answer; undefined before the first one. */
    data,
    /** Why it is out of date, if it is. */
    error,
  };
}

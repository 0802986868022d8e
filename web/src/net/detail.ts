// The details of a job in a list, read again when it has changed.

import { createEffect, createSignal, type Accessor } from 'solid-js';
import { get } from './requests';

/** `version` changes when the details change. An answer for a job that is no longer chosen is ignored. */
export function createDetail<S extends { readonly id: string }, D extends S>(
  path: string,
  summary: Accessor<S | undefined>,
  version: (summary: S) => string,
): Accessor<D | undefined> {
  const [detail, setDetail] = createSignal<D>();
  let pending: string | undefined;
  // Each message with the list requests the details again if the last answer did not arrive.
  createEffect(() => {
    const now = summary();
    const had = detail();
    if (!now) return;
    const requested = version(now);
    if (had && version(had) === requested) {
      pending = undefined;
      return;
    }
    if (pending === requested) return;
    pending = requested;
    void get<D>(`${path}/${now.id}`)
      .then((answer) => {
        if (pending === requested) setDetail(() => answer);
      })
      // The next message with the list tries again.
      .catch(() => undefined)
      .finally(() => {
        if (pending === requested) pending = undefined;
      });
  });
  return () => (detail()?.id === summary()?.id ? detail() : undefined);
}

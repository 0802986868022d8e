// The newest kept run that the user has seen. Lives as long as the page, because the button goes with the laboratory.

import { createSignal, type Signal } from 'solid-js';
import type { Session } from '../../lab/slices';

const seen = new WeakMap<Session, Signal<number | undefined>>();

/** Number of the newest run that the user has seen; undefined until the first scene. */
export function seenOf(lab: Session): Signal<number | undefined> {
  let signal = seen.get(lab);
  if (!signal) {
    signal = createSignal<number>();
    seen.set(lab, signal);
  }
  return signal;
}

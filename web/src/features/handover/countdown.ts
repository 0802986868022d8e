// How long the operator has to answer a request for control.

import { createEffect, createSignal, onCleanup, type Accessor } from 'solid-js';
import type { Session } from '../../lab/slices';

/** Whether this page has ended its own request, which the next `hello` shows. */
export const own = { isWithdrawn: false };

const EVERY_MS = 250;

/** Whole seconds until control passes on; undefined without a request. */
export function createCountdown({ hello }: Pick<Session, 'hello'>): Accessor<number | undefined> {
  const [left_s, setLeft] = createSignal<number>();
  createEffect(() => {
    const within_s = hello()?.answer_within_s ?? undefined;
    setLeft(within_s && Math.ceil(within_s));
    if (within_s === undefined) return;
    const until_ms = performance.now() + 1000 * within_s;
    const count = (): number =>
      setLeft(Math.max(0, Math.ceil((until_ms - performance.now()) / 1000)));
    const timer = setInterval(count, EVERY_MS);
    onCleanup(() => clearInterval(timer));
  });
  return left_s;
}

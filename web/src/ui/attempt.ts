// A change that the server may refuse.

import { createSignal } from 'solid-js';

/** The text of anything that was thrown. */
export const messageOf = (reason: unknown): string =>
  reason instanceof Error ? reason.message : String(reason);

/** Returns true if the change was done. */
export type Attempt = (change: Promise<unknown>) => Promise<boolean>;

/** `refusal` is why the last change was refused. */
export function createAttempt() {
  const [refusal, setRefusal] = createSignal<string>();
  const [open, setOpen] = createSignal(0);
  const attempt: Attempt = async (change) => {
    setRefusal(undefined);
    setOpen((count) => count + 1);
    try {
      await change;
      return true;
    } catch (reason) {
      setRefusal(messageOf(reason));
      return false;
    } finally {
      setOpen((count) => count - 1);
    }
  };
  return {
    attempt,
    refusal,
    isBusy: (): boolean => open() > 0,
    forget: () => setRefusal(undefined),
  };
}

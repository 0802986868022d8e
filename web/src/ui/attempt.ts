// A change that the server may refuse.

import { createSignal, type Accessor } from 'solid-js';

/** The text of anything that was thrown. */
export const messageOf = (reason: unknown): string =>
  reason instanceof Error ? reason.message : String(reason);

/** Returns true if the change was done. */
export type Attempt = (change: Promise<unknown>) => Promise<boolean>;

/** `refusal` is why the last change was refused. */
export function createAttempt(): {
  readonly attempt: Attempt;
  readonly refusal: Accessor<string | undefined>;
} {
  const [refusal, setRefusal] = createSignal<string>();
  const attempt = async (change: Promise<unknown>): Promise<boolean> => {
    setRefusal(undefined);
    try {
      await change;
      return true;
    } catch (reason) {
      setRefusal(messageOf(reason));
      return false;
    }
  };
  return { attempt, refusal };
}

// The value of a control between the user's choice and the server's answer.

import { createMemo, createSignal, type Accessor } from 'solid-js';

export type Pending<A> = ReturnType<typeof createPending<A>>;

/**
 * `send` resolves when the server has answered, after `truth` shows the effect. One choice is on its way at a time; of
 * those that wait for its answer, the newest is sent. `rest` is what is still to be sent of a newer choice.
 */
export function createPending<A>(
  truth: Accessor<A>,
  send: (value: A) => Promise<unknown>,
  rest: (wanted: A, sent: A) => A | undefined = (wanted, sent) =>
    wanted === sent ? undefined : wanted,
) {
  const [wanted, setWanted] = createSignal<{ readonly value: A }>();
  let isSending = false;
  const work = async (): Promise<void> => {
    if (isSending) return;
    isSending = true;
    for (let next = wanted(); next; next = wanted()) {
      const sent = next.value;
      await send(sent);
      setWanted((now) => {
        const left = now && rest(now.value, sent);
        return left === undefined ? undefined : { value: left };
      });
    }
    isSending = false;
  };
  return {
    /** What the control shows: the user's choice until it is answered, then the server's value. */
    value: createMemo(() => wanted()?.value ?? truth()),
    isPending: createMemo(() => wanted() !== undefined),
    choose: (value: A) => {
      setWanted({ value });
      void work();
    },
  };
}

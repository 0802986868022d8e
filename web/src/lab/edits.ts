// Pending changes of the parameters, shared by all forms of the page.

import { createEffect, createMemo, createSignal } from 'solid-js';
import type { Parameters } from '../net/protocol.gen';
import { createPending } from '../ui/pending';
import { withFollowers } from './parameters';
import type { Basis } from './basis';

type Change = Readonly<Partial<Parameters>>;

/** What a newer change has beyond one that was answered. */
function beyond(wanted: Change, sent: Change): Change | undefined {
  const left = Object.entries(wanted).filter(
    ([name, value]) => sent[name as keyof Parameters] !== value,
  );
  return left.length > 0 ? Object.fromEntries(left) : undefined;
}

export type Edits = ReturnType<typeof createEdits>;

export function createEdits(lab: Basis) {
  const [moving, setMoving] = createSignal<Change>({});
  const truth = createMemo(() => lab.scene()?.parameters);
  const none: Change = {};
  const edits = createPending<Change>(
    () => none,
    async (change) => {
      const now = truth();
      if (now) {
        await lab.send('controller', { type: 'configure', parameters: { ...now, ...change } });
      }
    },
    beyond,
  );
  createEffect(() => {
    // A slider that is disabled while the user moves it reports no release.
    if (!lab.canOperate()) setMoving({});
  });
  const values = createMemo(() => {
    const now = truth();
    return now && { ...now, ...edits.value() };
  });
  return {
    /** The server's values with pending edits. */
    values,
    /** The same with the value of a moving slider. */
    shown: createMemo(() => {
      const now = values();
      return now && { ...now, ...moving() };
    }),
    /** The value of a moving slider, which is not sent. */
    moving,
    move: (change: Change) => setMoving(change),
    /** Sends a change. */
    edit: (change: Change) => {
      const now = values();
      if (!now) return;
      setMoving({});
      edits.choose({ ...edits.value(), ...withFollowers(now, change) });
    },
  };
}

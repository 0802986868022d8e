// Pending changes of the parameters, shared by all forms of the page.

import { createEffect, createMemo, createSignal, type Accessor } from 'solid-js';
import type { Parameters } from '../net/protocol.gen';
import { createPending } from '../ui/pending';
import { withFollowers } from './parameters';
import type { Session, Trial } from './slices';

export interface Edits {
  /** The server's values with pending edits. */
  readonly values: Accessor<Parameters | undefined>;
  /** The same with the value of a moving slider. */
  readonly shown: Accessor<Parameters | undefined>;
  /** The value of a moving slider, which is not sent. */
  readonly moving: Accessor<Partial<Parameters>>;
  readonly isPending: (name: keyof Parameters) => boolean;
  move(change: Partial<Parameters>): void;
  /** Sends a change. */
  edit(change: Partial<Parameters>): void;
}

type Reads = Pick<Session, 'canOperate' | 'send'> & Pick<Trial, 'scene'>;
type Change = Readonly<Partial<Parameters>>;

/** What a newer change has beyond one that was answered. */
function beyond(wanted: Change, sent: Change): Change | undefined {
  const left = Object.entries(wanted).filter(
    ([name, value]) => sent[name as keyof Parameters] !== value,
  );
  return left.length > 0 ? Object.fromEntries(left) : undefined;
}

export function createEdits(lab: Reads): Edits {
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
    values,
    shown: createMemo(() => {
      const now = values();
      return now && { ...now, ...moving() };
    }),
    moving,
    isPending: (name) => name in edits.value(),
    move: setMoving,
    edit: (change) => {
      const now = values();
      if (!now) return;
      setMoving({});
      edits.choose({ ...edits.value(), ...withFollowers(now, change) });
    },
  };
}

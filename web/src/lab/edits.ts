// Pending changes of the parameters, shared by all forms of the page.

import { createEffect, createMemo, createSignal, on, onCleanup, type Accessor } from 'solid-js';
import { withFollowers } from './parameters';
import type { ClientMessage, Parameters, SceneMessage } from '../net/protocol.gen';

/** After this time without a confirmation, the page shows the server's value again. */
const CONFIRM_MS = 2000;

export interface Edits {
  /** The server's values with pending edits. */
  readonly values: Accessor<Parameters | undefined>;
  /** The same with the value of a moving slider. */
  readonly shown: Accessor<Parameters | undefined>;
  /** The value of a moving slider, which is not sent. */
  readonly moving: Accessor<Partial<Parameters>>;
  move(change: Partial<Parameters>): void;
  /** Sends a change. */
  edit(change: Partial<Parameters>): void;
}

interface Session {
  readonly scene: Accessor<SceneMessage | undefined>;
  readonly refusals: Accessor<number>;
  readonly canOperate: Accessor<boolean>;
  send(message: ClientMessage): void;
}

/** An edit is dropped when the server's parameters agree with it or when the server refuses it. */
export function createEdits(session: Session): Edits {
  const [edits, setEdits] = createSignal<Partial<Parameters>>({});
  const [moving, setMoving] = createSignal<Partial<Parameters>>({});
  const truth = createMemo(() => session.scene()?.parameters);
  let timer: ReturnType<typeof setTimeout> | undefined;
  const drop = (): void => {
    setEdits({});
  };
  createEffect(
    on(truth, (now) => {
      const open = Object.entries(edits()).filter(
        ([name, value]) => now?.[name as keyof Parameters] !== value,
      );
      setEdits(Object.fromEntries(open));
    }),
  );
  createEffect(on(session.refusals, drop, { defer: true }));
  createEffect(() => {
    // A slider that is disabled while the user moves it reports no release.
    if (!session.canOperate()) setMoving({});
  });
  onCleanup(() => {
    clearTimeout(timer);
  });
  const values = createMemo(() => {
    const now = truth();
    return now && { ...now, ...edits() };
  });
  return {
    values,
    shown: createMemo(() => {
      const now = values();
      return now && { ...now, ...moving() };
    }),
    moving,
    move: (change) => {
      setMoving(change);
    },
    edit: (change) => {
      const now = values();
      if (!now) return;
      const whole = withFollowers(now, change);
      setMoving({});
      setEdits({ ...edits(), ...whole });
      session.send({ type: 'configure', parameters: { ...now, ...whole } });
      clearTimeout(timer);
      timer = setTimeout(drop, CONFIRM_MS);
    },
  };
}

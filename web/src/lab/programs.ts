// The programs outside of Ferry that are connected now.

import { createMemo, type Accessor } from 'solid-js';
import { createPoll } from '../net/poll';
import type { Programs } from '../net/protocol.gen';

/** They appear within a second. */
const EVERY_MS = 700;

/** Names of those that are connected, and of one that is in use, in order. */
export function createPrograms(used: Accessor<string | undefined>): Accessor<readonly string[]> {
  const programs = createPoll<Programs>('/api/controllers', () => EVERY_MS);
  return createMemo<readonly string[]>(
    () => {
      const connected = (programs.data()?.programs ?? []).filter((one) => one.is_connected);
      const all = new Set(connected.map((one) => one.name));
      const own = used();
      if (own !== undefined) all.add(own);
      return [...all].sort();
    },
    [],
    { equals: (a, b) => a.join(' ') === b.join(' ') },
  );
}

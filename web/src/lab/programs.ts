// The programs outside of Ferry that are connected now.

import { createMemo, type Accessor } from 'solid-js';
import type { Catalog } from './catalog';

/** Names of those that are connected, and of one that is in use, in order. */
export function createPrograms(
  catalog: Catalog,
  used: Accessor<string | undefined>,
): Accessor<readonly string[]> {
  return createMemo<readonly string[]>(
    () => {
      const connected = (catalog.programs() ?? []).filter((one) => one.is_connected);
      const all = new Set(connected.map((one) => one.name));
      const own = used();
      if (own !== undefined) all.add(own);
      return [...all].sort();
    },
    [],
    { equals: (a, b) => a.join(' ') === b.join(' ') },
  );
}

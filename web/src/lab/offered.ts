// Which of the session's controllers can take part, also its program.

import { createMemo, type Accessor } from 'solid-js';
import type { ControllerName } from '../net/protocol.gen';
import { controllerLabel, CONTROLLERS } from './parameters';
import type { Trial } from './slices';

/** All that can take part. */
export const COMPARABLE: readonly ControllerName[] = [...CONTROLLERS, 'program'];

/** Those that can take part now: the program only while it is connected. */
export function createOffered(lab: Trial): {
  readonly offered: Accessor<readonly ControllerName[]>;
  readonly label: (name: ControllerName) => string;
} {
  const program = createMemo(() => {
    const last = lab.state()?.program;
    return last?.is_connected === true ? last.name : undefined;
  });
  return {
    offered: createMemo(() =>
      COMPARABLE.filter((name) => name !== 'program' || program() !== undefined),
    ),
    label: (name) =>
      controllerLabel({
        controller: name,
        program: name === 'program' ? (program() ?? null) : null,
      }),
  };
}

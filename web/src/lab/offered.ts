// Which of the session's controllers take part, also its program.

import { createMemo, type Accessor } from 'solid-js';
import type { ControllerName } from '../net/protocol.gen';
import { controllerLabel, CONTROLLERS } from './parameters';
import type { Trial } from './slices';

/** All that can take part. */
export const COMPARABLE: readonly ControllerName[] = [...CONTROLLERS, 'program'];

/** Those that take part, and the attributes of the field that chooses them. The program takes part only while it is connected. */
export function createTakingPart(
  lab: Trial,
  leftOut: Accessor<readonly ControllerName[]>,
  leaveOut: (names: readonly ControllerName[]) => void,
) {
  const program = createMemo(() => {
    const last = lab.state()?.program;
    return last?.is_connected === true ? last.name : undefined;
  });
  const offered = createMemo(() =>
    COMPARABLE.filter((name) => name !== 'program' || program() !== undefined),
  );
  const wanted = (): ControllerName[] => offered().filter((name) => !leftOut().includes(name));
  return {
    wanted,
    field: {
      name: 'controllers',
      label: 'Controllers',
      hideLabel: true,
      missing: 'Choose at least one controller.',
      get all() {
        return offered();
      },
      get value() {
        return wanted();
      },
      text: (name: ControllerName) =>
        controllerLabel({
          controller: name,
          program: name === 'program' ? (program() ?? null) : null,
        }),
      onChoose: (names: readonly ControllerName[]) =>
        leaveOut(offered().filter((name) => !names.includes(name))),
    },
  };
}

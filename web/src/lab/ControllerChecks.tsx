// Which of the session's controllers take part: one check box for each, also for its program.

import { For, createMemo, type Accessor, type JSX } from 'solid-js';
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

export function ControllerChecks(props: {
  /** What is done with them, before each name. */
  verb: string;
  offered: readonly ControllerName[];
  label: (name: ControllerName) => string;
  isChosen: (name: ControllerName) => boolean;
  onToggle: (name: ControllerName, on: boolean) => void;
}): JSX.Element {
  return (
    <fieldset>
      <legend class="visually-hidden">Controllers</legend>
      <For each={props.offered}>
        {(name) => (
          <label class="check">
            <input
              type="checkbox"
              checked={props.isChosen(name)}
              aria-label={`${props.verb} ${props.label(name)}`}
              onChange={(event) => {
                props.onToggle(name, event.currentTarget.checked);
              }}
            />
            {props.label(name)}
          </label>
        )}
      </For>
    </fieldset>
  );
}

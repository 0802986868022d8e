// Marks of the script on the timeline: hollow, because they have not happened yet or happen again after a reset.

import { For, type JSX } from 'solid-js';
import { describe } from '../../lab/disturbance';
import { clock } from '../../ui/format';
import type { Trial } from '../../lab/slices';

export function ScriptMarks(props: { lab: Trial; oldest: number; newest: number }): JSX.Element {
  const planned = () =>
    (props.lab.scene()?.scenario.script ?? []).flatMap(({ at, disturbance }) =>
      'tick' in at && at.tick >= props.oldest && at.tick <= props.newest
        ? [{ tick: at.tick, disturbance }]
        : [],
    );
  const position = (tick: number): string =>
    `${(100 * (tick - props.oldest)) / Math.max(1, props.newest - props.oldest)}%`;
  return (
    <svg class="script-marks" aria-hidden="true">
      <For each={planned()}>
        {({ tick, disturbance }) => (
          <circle cx={position(tick)} cy="50%" r="4">
            <title>
              {`Script at ${clock(tick * (props.lab.scene()?.tick_s ?? 0))}: ${describe(disturbance)}`}
            </title>
          </circle>
        )}
      </For>
    </svg>
  );
}

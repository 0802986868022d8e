// What is ahead on the time line, or happens again after a reset: disturbances of the script, and in a challenge the
// times of the rivals.

import { For, createMemo, type JSX } from 'solid-js';
import { Flag } from 'lucide';
import { describe } from '../../lab/disturbance';
import { CONTROLLER_LABELS } from '../../lab/parameters';
import type { TimeAxis } from '../../lab/timeAxis';
import type { Contested, Trial } from '../../lab/slices';
import { LOOKS } from '../../ui/controllers';
import { clock, seconds } from '../../ui/format';
import { Icon } from '../../ui/Icon';
import { percent } from './Band';

export function PlannedMarks(props: { lab: Trial & Contested; axis: TimeAxis }): JSX.Element {
  const { lab, axis } = props;
  const onAxis = (time_s: number): boolean => axis.share(time_s) >= 0 && axis.share(time_s) <= 1;
  const planned = createMemo(() => {
    const scene = lab.scene();
    return (scene?.scenario.script ?? []).flatMap(({ at, disturbance }) => {
      const time_s = 'tick' in at && scene ? at.tick * scene.tick_s : NaN;
      return onAxis(time_s) ? [{ time_s, disturbance }] : [];
    });
  });
  const rivals = createMemo(() =>
    (lab.contest.ghosts()?.ghosts ?? []).flatMap(({ controller, player, total_s }) =>
      total_s !== null && onAxis(total_s) ? [{ controller, player, total_s }] : [],
    ),
  );
  return (
    <>
      <svg class="script-marks" aria-hidden="true">
        <For each={planned()}>
          {({ time_s, disturbance }) => (
            <circle cx={percent(axis.share(time_s))} cy="50%" r="4">
              <title>{`Script at ${clock(time_s)}: ${describe(disturbance)}`}</title>
            </circle>
          )}
        </For>
      </svg>
      <For each={rivals()}>
        {({ controller, player, total_s }) => (
          <span
            class="mark rival"
            role="img"
            aria-label={`${player ?? CONTROLLER_LABELS[controller]}: ${seconds(total_s)}`}
            title={`${player ?? CONTROLLER_LABELS[controller]}: ${seconds(total_s)}`}
            style={{
              left: percent(axis.share(total_s)),
              color: `var(--${LOOKS[controller].colour})`,
            }}
          >
            <Icon of={Flag} />
          </span>
        )}
      </For>
    </>
  );
}

// A share with its interval, as a bar from 0 to 1 with a tick. The numbers are beside it.

import type { JSX } from 'solid-js';
import './Interval.css';

const percent = (share: number): string => `${100 * share}%`;

export function Interval(props: {
  share: number;
  interval: readonly [low: number, high: number];
}): JSX.Element {
  return (
    <div class="interval" aria-hidden="true">
      <u
        style={{
          left: percent(props.interval[0]),
          width: percent(props.interval[1] - props.interval[0]),
        }}
      />
      <b style={{ left: `min(${percent(props.share)}, 100% - 3px)` }} />
    </div>
  );
}

// Drawing of a share with its interval.

import type { JSX } from 'solid-js';

/** In units of the viewBox. */
const WIDTH = 100;
const HEIGHT = 10;

export function IntervalBar(props: {
  share: number;
  interval: readonly [number, number];
}): JSX.Element {
  const width = (): number => Math.max(1, WIDTH * (props.interval[1] - props.interval[0]));
  return (
    <svg
      class="interval"
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      preserveAspectRatio="none"
      aria-hidden="true"
    >
      <path class="axis" d={`M0 ${HEIGHT / 2}H${WIDTH}`} />
      <rect
        class="range"
        x={Math.min(WIDTH - width(), WIDTH * props.interval[0])}
        y="2.5"
        width={width()}
        height="5"
      />
      <path
        class="at"
        d={`M${Math.min(WIDTH - 0.75, Math.max(0.75, WIDTH * props.share))} 0V${HEIGHT}`}
      />
    </svg>
  );
}

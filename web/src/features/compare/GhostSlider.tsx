// The slider over the time of the ghosts.

import type { JSX } from 'solid-js';
import { lastTick } from '../../lab/comparison';
import type { Compared } from '../../lab/slices';
import type { ComparisonMessage } from '../../net/protocol.gen';
import { fixed } from '../../ui/format';

export function GhostSlider(props: {
  lab: Compared;
  comparison: ComparisonMessage;
  tick_s: number;
  style?: JSX.CSSProperties;
}): JSX.Element {
  const ghosts = props.lab.comparison;
  const since_s = (): number => (ghosts.tick() - props.comparison.tick) * props.tick_s;
  return (
    <input
      type="range"
      aria-label="Time of the ghosts"
      aria-valuetext={`${fixed(since_s(), 1)} seconds after the moment`}
      style={props.style}
      min={props.comparison.tick}
      max={lastTick(props.comparison)}
      step={props.comparison.ticks_a_sample}
      value={ghosts.tick()}
      onInput={(event) => {
        ghosts.look(event.currentTarget.valueAsNumber);
      }}
    />
  );
}

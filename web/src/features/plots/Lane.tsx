// One part of the figure over the time of the time line, with what it is on the left and its range on the right.

import { For, Show, createMemo, createSignal, onMount, type JSX } from 'solid-js';
import { Curve } from '../../ui/CurvePlot';
import { LineKey } from '../../ui/LineKey';
import type { CurveContext } from '../../ui/curve';
import { clock, fixed } from '../../ui/format';
import { onSize } from '../../ui/size';
import type { TimeAxis } from '../../lab/timeAxis';
import { linesOf, type Part, partRange, rulesOf, thresholdAbove } from './parts';
import { nearestIndex, type Sample } from './sample';
import { laneTicks, timeTicks } from './ticks';

export function Lane(props: {
  part: Part;
  axis: TimeAxis;
  sample: Sample | undefined;
  /** Threshold T. */
  threshold_m: number | undefined;
}): JSX.Element {
  const { axis } = props;
  let lane!: HTMLDivElement;
  const [height_px, setHeight] = createSignal(0);
  onMount(() => onSize(lane, ({ height }) => setHeight(height)));
  const times = (): Float64Array => props.sample?.columns.sim_time_s ?? new Float64Array();
  const lines = createMemo(() => linesOf(props.part, props.sample));
  const range = createMemo(() => partRange(props.part, lines(), props.threshold_m));
  /** Downwards, with the share of the axis that is above each. */
  const numbers = createMemo(() => {
    const [low, high] = range();
    const ticks = laneTicks([low, high], height_px());
    return (ticks.length > 0 ? ticks : [low, high]).reverse().map((value, index) => ({
      above: (high - value) / (high - low),
      text: `${fixed(value, Number.isInteger(value) ? 0 : 1)}${index > 0 ? '' : ` ${props.part.unit}`}`,
    }));
  });
  /** At the cursor, otherwise at the present time. */
  const marked = createMemo(() => {
    const { sample } = props;
    return sample && nearestIndex(times(), axis.pointed_s() ?? sample.at_s);
  });
  const values = createMemo(() => {
    const index = marked();
    return lines().map((values) =>
      index === undefined ? '–' : fixed(values[index] ?? 0, props.part.digits + 1),
    );
  });
  const words = (): string => {
    const [{ part }, index] = [props, marked()];
    if (index === undefined) return `${part.title} over time: no data yet`;
    const read = part.lines.map(({ label }, line) => `${label} ${values()[line]} ${part.unit}`);
    return `${part.title} over time, at ${clock(times()[index] ?? 0)}: ${read.join(', ')}`;
  };
  const context: CurveContext = {
    isBare: true,
    lines: props.part.lines,
    xRange: () => [props.sample?.from_s ?? 0, props.sample?.to_s ?? 1],
    yRange: () => range(),
    xSplits: () => timeTicks(axis.span()),
    ySplits: (height) => laneTicks(range(), height),
    // When sub-controller 1 was active.
    shades: () =>
      (props.sample?.approaches ?? []).map(([from, to]) => ({ from, to, color: 'ink-3' })),
    rules: createMemo(() => rulesOf(props.part, props.sample, props.threshold_m, range())),
    onCursor: (index) => axis.point(index === undefined ? undefined : times()[index]),
  };
  return (
    <div ref={lane} class="lane" data-part={props.part.letter}>
      <div class="lane-names">
        <Show
          when={props.part.lines.length > 1}
          fallback={
            <>
              <span>{props.part.title}</span>
              <strong class="number">
                {values()[0]} {props.part.unit}
              </strong>
            </>
          }
        >
          <For each={props.part.lines}>
            {(line, index) => (
              <span>
                <LineKey of={line} />
                {line.label} {props.part.title}
                <b class="number">{values()[index()]}</b>
              </span>
            )}
          </For>
        </Show>
      </div>
      <Curve name={words()} context={context} data={[times(), ...lines()]} at={axis.pointed_s()} />
      <div class="lane-range number" aria-hidden="true">
        <For each={numbers()}>
          {({ above, text }) => <span style={{ '--above': above }}>{text}</span>}
        </For>
      </div>
      <Show when={thresholdAbove(props.part, props.threshold_m, range())}>
        {(words) => <p class="lane-note number">{words()}</p>}
      </Show>
    </div>
  );
}

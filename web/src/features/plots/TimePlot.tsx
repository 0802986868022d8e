// One part of the figure over time, with its caption.

import { createMemo, type JSX } from 'solid-js';
import { CurvePlot } from '../../ui/CurvePlot';
import type { CurveContext } from '../../ui/curve';
import { clock, fixed } from '../../ui/format';
import type { Figure } from './figure';
import { linesOf, type Part, partRange, rulesOf } from './parts';
import type { Sample } from './sample';

/** Number of decimals needed to distinguish multiples of `step`. */
function decimals(step: number): number {
  return String(step).split('.')[1]?.length ?? 0;
}

export function TimePlot(props: {
  part: Part;
  figure: Figure;
  sample: Sample | undefined;
  /** Threshold T. */
  threshold_m: number | undefined;
}): JSX.Element {
  const { part, figure } = props;
  const times = (): Float64Array => props.sample?.columns.sim_time_s ?? new Float64Array();
  const lines = createMemo(() => linesOf(part, props.sample));
  /** At the cursor, otherwise at the present time. */
  const marked = createMemo(() => figure.indexIn(props.sample));
  const values = createMemo(() => {
    const index = marked();
    return lines().map((values) =>
      index === undefined ? '–' : fixed(values[index] ?? 0, part.digits + 1),
    );
  });
  const words = (): string => {
    const index = marked();
    if (index === undefined) return `${part.title} over time: no data yet`;
    const read = part.lines.map(({ label }, line) => `${label} ${values()[line]} ${part.unit}`);
    return `${part.title} over time, at ${clock(times()[index] ?? 0)}: ${read.join(', ')}`;
  };
  const context: CurveContext = {
    lines: part.lines,
    xRange: () => [props.sample?.from_s ?? 0, props.sample?.to_s ?? 1],
    yRange: (max, min) => partRange(part, min, max, props.threshold_m),
    xText: (value) => `${value} s`,
    yText: (value, step) => fixed(value, Math.max(part.digits, decimals(step))),
    // When sub-controller 1 was active.
    shades: () =>
      (props.sample?.approaches ?? []).map(([from, to]) => ({ from, to, color: 'ink-3' })),
    rules: createMemo(() => rulesOf(part, props.sample, props.threshold_m)),
    onCursor: (index) => {
      figure.point(index === undefined ? undefined : times()[index]);
    },
  };
  return (
    <CurvePlot
      letter={part.letter}
      title={part.title}
      unit={part.unit}
      name={words()}
      keys={part.lines}
      values={values()}
      context={context}
      data={[times(), ...lines()]}
      at={figure.pointed_s()}
    />
  );
}

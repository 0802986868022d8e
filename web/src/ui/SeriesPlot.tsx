// A plot of values with their intervals, one line beside another, and what the pointer reads from it.

import { createMemo, createSignal, type JSX } from 'solid-js';
import type { CurveContext, CurveLine } from './curve';
import { CurvePlot } from './CurvePlot';
import { fixed } from './format';
import { columnsOf, type Measure, type Points, readWords } from './series';

/** The common axis. */
export interface Along extends Pick<CurveContext, 'xRange' | 'xSplits' | 'xText'> {
  /** As in `over the updates`. */
  readonly words: string;
  /** A place on it: `After 500 updates`. */
  readonly at: (x: number) => string;
}

export function SeriesPlot(props: {
  class: string;
  measure: Measure;
  /** Their number does not change. */
  lines: readonly Pick<CurveLine, 'label' | 'color' | 'isDashed'>[];
  /** Of each line. */
  points: readonly Points[];
  along: Along;
  /** What is said while nothing is read; without, the last values. */
  help?: string | undefined;
}): JSX.Element {
  const { measure, along } = props;
  const [pointed, setPointed] = createSignal<number>();
  const data = createMemo(() => columnsOf(props.points));
  const hasBars = measure.intervals !== 'band';
  const edges = props.lines.map((_, line) => [3 * line, 3 * line + 1] as const);
  const context: CurveContext = {
    ...along,
    lines: props.lines.flatMap((line) => {
      const edge = { label: '', color: line.color, isEdge: true, joinsGaps: true };
      return [edge, edge, { ...line, joinsGaps: true, hasPoints: hasBars }];
    }),
    bands: measure.intervals === 'bars' ? [] : edges,
    bars: hasBars ? edges : [],
    yRange: (max, min) => [...measure.range(max, min)],
    yText: (value) => fixed(value, measure.axisDigits),
    onCursor: setPointed,
  };
  const read = (index: number): string | undefined => {
    const labels = props.lines.map(({ label }) => label);
    const words = readWords(measure, labels, data(), index);
    return words && `${along.at(data()[0][index] ?? 0)}: ${words}`;
  };
  const last = createMemo(() => {
    const indices = data()[0].map((_, index) => index);
    return indices.reverse().map(read).find(Boolean) ?? 'No points yet.';
  });
  const words = (): string => {
    const index = pointed();
    return (index === undefined ? undefined : read(index)) ?? props.help ?? last();
  };
  return (
    <div class={props.class}>
      <CurvePlot
        title={measure.title}
        unit={measure.unit}
        name={`${measure.title} over ${along.words}, ${measure.unit}. ${last()}`}
        context={context}
        data={data()}
      />
      <p class="rule number">{words()}</p>
    </div>
  );
}

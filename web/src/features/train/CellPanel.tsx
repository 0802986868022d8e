// The chosen cell: its distance and value, and its fan of quantiles over the updates.

import { Show, createMemo, createSignal, type JSX } from 'solid-js';
import type uPlot from 'uplot';
import type { TrainingCells, TrainingFrame } from '../../net/protocol.gen';
import type { CurveContext } from '../../ui/curve';
import { CurvePlot } from '../../ui/CurvePlot';
import { counted, fixed } from '../../ui/format';
import { alongUpdates, rangeAround } from './curves';
import { fanAt } from './grid';

const LINE = { color: 'rl', joinsGaps: true } as const;

export function CellPanel(props: {
  cells: TrainingCells;
  cell: number;
  frame: TrainingFrame | undefined;
  /** All that have been read. */
  frames: readonly TrainingFrame[];
  /** Number of all value maps. */
  count: number;
  /** Updates at the end of the training. */
  total: number;
}): JSX.Element {
  const [pointed, setPointed] = createSignal<number>();
  const fan = createMemo(() => fanAt(props.frames, props.cell));
  const quantile = (index: number): readonly number[] => fan().quantiles[index] ?? [];
  const context: CurveContext = {
    ...alongUpdates(() => props.total),
    lines: [
      { ...LINE, label: '.95', isEdge: true },
      { ...LINE, label: '.05', isEdge: true },
      { ...LINE, label: '.75', isEdge: true },
      { ...LINE, label: '.25', isEdge: true },
      { ...LINE, label: 'median', hasPoints: true },
    ],
    bands: [
      [0, 1],
      [2, 3],
    ],
    yRange: rangeAround,
    yText: (value) => fixed(value, 2),
    rules: createMemo(() =>
      props.frame
        ? [{ axis: 'x', at: props.frame.update, label: '', color: 'ink', dashed: true } as const]
        : [],
    ),
    onCursor: setPointed,
  };
  const data = createMemo<uPlot.AlignedData>(() => [
    [...fan().updates],
    ...[4, 0, 3, 1, 2].map((index) => [...quantile(index)]),
  ]);
  const center = (): readonly [number, number] => props.cells.centers_m[props.cell] ?? [0, 0];
  const stepWords = (): string => {
    const steps = props.cells.steps[props.cell] ?? null;
    return steps === null ? 'no path to the goal' : `${counted(steps, 'step')} to the goal`;
  };
  const value = (): string => fixed(props.frame?.values[props.cell] ?? NaN, 2);
  const pointedWords = (): string | undefined => {
    const index = pointed();
    if (index === undefined) return undefined;
    const at = (one: number): string => fixed(quantile(one)[index] ?? NaN, 2);
    return `After ${fan().updates[index] ?? 0} updates: median ${at(2)}, half of the returns from ${at(1)} to ${at(3)}.`;
  };
  return (
    <div class="train-cell">
      <p class="number" role="status" data-testid="train-cell">
        Cell at x {fixed(center()[0], 2)}, y {fixed(center()[1], 2)} m: {stepWords()}
        <Show when={props.frame}>
          {(frame) => (
            <>
              , value {value()} after {counted(frame().update, 'update')}
            </>
          )}
        </Show>
        .
      </p>
      <CurvePlot
        title="Expected return at this cell"
        unit="over the updates"
        name={`Quantiles of the return at this cell over the updates: ${counted(props.frames.length, 'value map')} of ${props.count}`}
        keys={[{ label: 'median', color: 'rl' }]}
        context={context}
        data={data()}
      />
      <p class="rule">
        {pointedWords() ??
          'The return is the sum of all later rewards; later ones count less. Inner band: half of the returns. Outer band: 90 % of them.'}
      </p>
    </div>
  );
}

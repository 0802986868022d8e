// Robustness: curves over one varied parameter, a grid of shares over two.

import { For, Index, Show, createMemo, createSignal, type JSX } from 'solid-js';
import { CurvePlot } from '../../ui/CurvePlot';
import type { CurveContext, CurveLine } from '../../ui/curve';
import { counted, fixed } from '../../ui/format';
import { createPalette } from '../../ui/palette';
import type { Theme } from '../../ui/theme';
import type { EvaluationSummary, Row } from '../../net/protocol.gen';
import {
  columnsOf,
  gridOf,
  type Line,
  type Measure,
  MEASURES,
  type Picture,
  picturesOf,
  readWords,
  valuesOf,
} from './robustness';
import { percentRange } from './table';
import { axisWords, numberField } from './varied';
import './robustness.css';

/** Strongest colour of the grid, in percent: its numbers stay readable. */
const STRONGEST = 60;

/** A dashed line leaves the one below it visible where both are equal. */
function keysOf({ lines }: Picture): CurveLine[] {
  return lines.map(({ label, controller }, index) => ({
    label,
    color: controller,
    isDashed: index % 2 === 1,
    joinsGaps: true,
    hasPoints: true,
  }));
}

function Curve(props: {
  picture: Picture;
  measure: Measure;
  name: string;
  theme: () => Theme;
}): JSX.Element {
  const palette = createPalette(() => props.theme());
  const [pointed, setPointed] = createSignal<number>();
  const data = createMemo(() => columnsOf(props.measure, props.picture));
  // Their number does not change: they are those of the query.
  const keys = keysOf(props.picture);
  const edges = keys.map((_, line) => [3 * line, 3 * line + 1] as const);
  const range = (): readonly [number, number] => {
    const values = data()[0];
    const [from, to] = [values[0] ?? 0, values.at(-1) ?? 1];
    const air = 0.05 * (to - from) || 1;
    return [from - air, to + air];
  };
  const context: CurveContext = {
    palette,
    lines: keys.flatMap((key) => {
      const edge = { label: '', color: key.color, isEdge: true };
      return [edge, edge, key];
    }),
    bars: edges,
    xRange: () => [...range()],
    yRange: (max) => [...(props.measure.range ?? [0, 1.1 * max || 1])],
    xText: (value) => String(Number(value.toPrecision(6))),
    yText: (value) => fixed(value, 0),
    rules: () => [],
    onCursor: setPointed,
  };
  const words = (): string => {
    const index = pointed() ?? data()[0].length - 1;
    const value = data()[0][index];
    if (value === undefined) return 'No row yet.';
    const { label, unit } = numberField(props.name);
    const read = readWords(props.measure, props.picture, data(), index);
    return `${[label, value, unit].filter((part) => part !== '').join(' ')}: ${read}`;
  };
  return (
    <div class="robustness-curve">
      <CurvePlot
        title={props.measure.title}
        unit={props.measure.unit}
        name={`${props.measure.title} over ${axisWords(props.name)}. ${words()}`}
        theme={props.theme}
        keys={[]}
        context={context}
        data={data()}
      />
      <p class="hint number">{words()}</p>
    </div>
  );
}

function GridCell(props: { row: Row | undefined }): JSX.Element {
  return (
    <Show when={props.row} fallback={<td class="none">–</td>}>
      {(row) => {
        const share = (): number => row().delivered / row().episodes;
        return (
          <td
            title={`${row().delivered} of ${row().episodes} (${percentRange(row().wilson95)})`}
            style={{
              background: `color-mix(in srgb, var(--goal) ${fixed(STRONGEST * share(), 0)}%, var(--panel))`,
            }}
          >
            {fixed(100 * share(), 0)}
          </td>
        );
      }}
    </Show>
  );
}

function Grid(props: { picture: Picture; line: Line; names: readonly string[] }): JSX.Element {
  const ups = (): number[] => valuesOf(props.picture, 0).reverse();
  const grid = createMemo(() => gridOf(props.picture, props.line));
  return (
    <table class="robustness-grid number">
      <caption>{props.line.label}: delivered, %</caption>
      <tbody>
        <For each={ups()}>
          {(up, index) => (
            <tr>
              <Show when={index() === 0}>
                <th class="robustness-up" scope="rowgroup" rowspan={ups().length}>
                  <span>{axisWords(props.names[0] ?? '')}</span>
                </th>
              </Show>
              <th scope="row">{up}</th>
              <For each={grid()[index()]}>{(row) => <GridCell row={row} />}</For>
            </tr>
          )}
        </For>
      </tbody>
      <tfoot>
        <tr>
          <td colspan="2" />
          <For each={valuesOf(props.picture, 1)}>{(right) => <th scope="col">{right}</th>}</For>
        </tr>
        <tr>
          <td colspan="2" />
          <th scope="colgroup" colspan={valuesOf(props.picture, 1).length}>
            {axisWords(props.names[1] ?? '')}
          </th>
        </tr>
      </tfoot>
    </table>
  );
}

export interface RobustnessProps {
  readonly summary: EvaluationSummary;
  readonly rows: readonly Row[];
  readonly theme: () => Theme;
}

export function RobustnessPlots(props: RobustnessProps): JSX.Element {
  const pictures = createMemo(() => picturesOf(props.summary.cells, props.rows));
  const names = createMemo(() => props.summary.query.vary.map(({ name }) => name));
  return (
    <Index each={pictures()}>
      {(picture) => (
        <section
          class="robustness"
          aria-label={`Robustness on ${picture().map}, ${counted(picture().disturbances, 'disturbance')}`}
        >
          <h3>
            {picture().map}, {counted(picture().disturbances, 'disturbance')}, over{' '}
            {names().map(axisWords).join(' and ')}
          </h3>
          <Show
            when={names().length === 1}
            fallback={
              <div class="robustness-grids">
                <Index each={picture().lines}>
                  {(line) => <Grid picture={picture()} line={line()} names={names()} />}
                </Index>
              </div>
            }
          >
            <p class="robustness-keys">
              <For each={keysOf(picture())}>
                {({ label, color, isDashed }) => (
                  <span class="key" data-color={color} data-dashed={isDashed ? '' : undefined}>
                    {label}
                  </span>
                )}
              </For>
            </p>
            <div class="robustness-curves">
              <For each={MEASURES}>
                {(measure) => (
                  <Curve
                    picture={picture()}
                    measure={measure}
                    name={names()[0] ?? ''}
                    theme={props.theme}
                  />
                )}
              </For>
            </div>
          </Show>
        </section>
      )}
    </Index>
  );
}

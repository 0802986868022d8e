// Robustness: curves over one varied parameter, a grid of shares over two.

import { For, Index, Show, createMemo, type JSX } from 'solid-js';
import { Keys } from '../../ui/CurvePlot';
import type { CurveLine } from '../../ui/curve';
import { counted, fixed } from '../../ui/format';
import { type Along, SeriesPlot } from '../../ui/SeriesPlot';
import type { EvaluationSummary, Row } from '../../net/protocol.gen';
import {
  gridOf,
  type Line,
  MEASURES,
  type Picture,
  picturesOf,
  pointsOf,
  valuesOf,
} from './robustness';
import { percentRange } from './table';
import { axisWords, numberField } from './varied';
import './robustness.css';

/** Strongest colour of the grid, in percent: its numbers stay readable. */
const STRONGEST = 60;

/** A dashed line leaves the one below it visible where both are equal. */
const styled = ({ lines }: Picture): CurveLine[] =>
  lines.map(({ label, controller }, index) => ({
    label,
    color: controller,
    isDashed: index % 2 === 1,
  }));

/** The axis of a varied parameter. */
function alongParameter(name: string, picture: () => Picture): Along {
  const { label, unit } = numberField(name);
  return {
    words: axisWords(name),
    at: (value) => [label, value, unit].filter((part) => part !== '').join(' '),
    xRange: () => {
      const values = valuesOf(picture(), 0);
      const [from, to] = [values[0] ?? 0, values.at(-1) ?? 1];
      const air = 0.05 * (to - from) || 1;
      return [from - air, to + air];
    },
    xText: (value) => String(Number(value.toPrecision(6))),
  };
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
              background: `color-mix(in srgb, var(--goal) ${fixed(STRONGEST * share(), 0)}%, var(--surface))`,
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

export function RobustnessPlots(props: {
  summary: EvaluationSummary;
  rows: readonly Row[];
}): JSX.Element {
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
              <Keys lines={styled(picture())} />
            </p>
            <div class="robustness-curves">
              <For each={MEASURES}>
                {(measure) => (
                  <SeriesPlot
                    class="robustness-curve"
                    measure={measure}
                    lines={styled(picture())}
                    points={pointsOf(measure, picture())}
                    along={alongParameter(names()[0] ?? '', picture)}
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

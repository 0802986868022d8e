// The rows as they arrive. The paper's numbers are below the rows that have them.

import { For, Index, Show, type JSX } from 'solid-js';
import { controllerLabel } from '../../lab/parameters';
import { isActive } from '../../lab/trainingStage';
import type { EvaluationCell, EvaluationSummary, PaperRow, Row } from '../../net/protocol.gen';
import { fixed } from '../../ui/format';
import { Interval } from '../../ui/Interval';
import { Cells, type Column, Heads } from '../../ui/Table';
import { Named } from './Named';
import { cm, percentRange, ratio } from './table';
import { variedWords } from './varied';
import './tables.css';

function Share(props: {
  count: number;
  of: number;
  interval: readonly [number, number];
}): JSX.Element {
  return (
    <div class="count">
      <b>
        {props.count}/{props.of}
      </b>
      <span class="range-words">{percentRange(props.interval)}</span>
      <Interval share={props.count / props.of} interval={props.interval} />
    </div>
  );
}

const ABOUT: readonly Column<EvaluationCell>[] = [
  {
    name: 'Controller',
    unit: 'map',
    isHead: true,
    cell: (one) => (
      <>
        <Named of={one.controller}>{controllerLabel(one)}</Named>
        <small>{one.map}</small>
      </>
    ),
  },
];
const VARIED: Column<EvaluationCell> = {
  name: 'Varied',
  cell: ({ varied }) => variedWords(varied),
};
const DISTURBANCES: Column<EvaluationCell> = {
  name: 'Dist.',
  title: 'Scripted disturbances per episode',
  cell: ({ disturbances }) => disturbances,
};

/** What the paper has, too. */
type Common = Pick<PaperRow, keyof Row & keyof PaperRow>;

const MEASURED: readonly (Column<Row> & { readonly paper?: (row: Common) => JSX.Element })[] = [
  {
    name: 'Reached',
    unit: '95 % Wilson',
    title: 'The tool came within 2 cm of the goal, as in the paper',
    cell: reached,
    paper: reached,
  },
  {
    name: 'Delivered',
    unit: '95 % Wilson',
    title: 'The bead came within 2 cm of the goal, released, within 5 s after the tool',
    cell: (row) => <Share count={row.delivered} of={row.episodes} interval={row.wilson95} />,
  },
  {
    name: 'Error',
    unit: 'cm; x · y',
    title:
      'Distance between tool and bead during transport, and its largest differences in x and y: means over the episodes',
    cell: error,
    paper: error,
  },
  {
    name: 'Path ÷ shortest',
    title:
      "Length of the tool's path while it carries the bead, divided by the shortest possible path of the bead; mean over the episodes that delivered",
    cell: (row) => ratio(row.path_ratio_mean),
  },
  {
    name: 'Steps',
    unit: 'switches',
    title: 'Control steps, and switches of the active sub-controller: means over the episodes',
    cell: (row) => (
      <>
        {fixed(row.steps_mean, 1)}
        <small>{fixed(row.switches_mean, 2)}</small>
      </>
    ),
  },
  {
    name: 'Decision',
    unit: 'ms; p99',
    title:
      'Computing time of a control step with its camera image: median and 99th percentile, including all other work of this machine',
    cell: (row) => (
      <>
        {fixed(row.decision_ms_p50, 1)}
        <small>{fixed(row.decision_ms_p99, 1)}</small>
      </>
    ),
  },
];

function reached({ successes, episodes, successes_wilson95 }: Common): JSX.Element {
  return <Share count={successes} of={episodes} interval={successes_wilson95} />;
}

function error(row: Common): JSX.Element {
  const { tracking_error_max_x_m: x_m, tracking_error_max_y_m: y_m } = row;
  return (
    <>
      {cm(row.tracking_error_mean_m)}
      <Show when={x_m !== null && y_m !== null}>
        <small>
          {cm(x_m)} · {cm(y_m)}
        </small>
      </Show>
    </>
  );
}

/** A cell whose row has not arrived. */
function pendingWords({ done, delivered }: EvaluationCell, summary: EvaluationSummary): string {
  const hasEnded = !isActive(summary);
  if (done === 0) return hasEnded ? 'not started' : 'waiting';
  const counted = `${done} of ${summary.query.episodes} episodes, ${delivered} delivered`;
  return hasEnded ? `stopped after ${counted}` : `${counted} so far`;
}

function Paper(props: { paper: PaperRow; columns: number }): JSX.Element {
  return (
    <tr class="paper">
      <th scope="row" colspan={props.columns}>
        paper, {props.paper.section}: “{props.paper.printed}”
      </th>
      <For each={MEASURED}>
        {({ name, paper }) => <td data-label={name}>{paper?.(props.paper) ?? '–'}</td>}
      </For>
    </tr>
  );
}

export function EvaluationTable(props: {
  summary: EvaluationSummary;
  rows: readonly Row[];
}): JSX.Element {
  const about = (): readonly Column<EvaluationCell>[] =>
    props.summary.query.vary.length > 0
      ? [...ABOUT, VARIED, DISTURBANCES]
      : [...ABOUT, DISTURBANCES];
  return (
    <div class="table-frame" tabindex="0" role="region" aria-label="Results">
      <table class="data-table">
        <thead>
          <tr>
            <Heads columns={[...about(), ...MEASURED]} />
          </tr>
        </thead>
        <tbody>
          {/* By index: new data changes a row's content and does not replace the row. */}
          <Index each={props.summary.cells}>
            {(cell, index) => (
              <>
                <tr data-testid="evaluation-row">
                  <Cells columns={about()} row={cell()} />
                  <Show
                    when={props.rows[index]}
                    fallback={
                      <td class="pending" colspan={MEASURED.length}>
                        {pendingWords(cell(), props.summary)}
                      </td>
                    }
                  >
                    {(row) => <Cells columns={MEASURED} row={row()} />}
                  </Show>
                </tr>
                <Show when={cell().paper}>
                  {(paper) => <Paper paper={paper()} columns={about().length} />}
                </Show>
              </>
            )}
          </Index>
        </tbody>
      </table>
    </div>
  );
}

// The rows as they arrive. The paper's numbers are below the rows that have them.

import { For, Index, Show, type JSX } from 'solid-js';
import { controllerLabel } from '../../lab/parameters';
import { isActive } from '../../lab/trainingStage';
import type { EvaluationCell, EvaluationSummary, PaperRow, Row } from '../../net/protocol.gen';
import { fixed } from '../../ui/format';
import { Cells, type Column, Heads } from '../../ui/Table';
import { IntervalBar } from './IntervalBar';
import { cm, decisionWords, percentRange, ratio } from './table';
import { variedWords } from './varied';
import './tables.css';

function Share(props: {
  count: number;
  of: number;
  interval: readonly [number, number];
}): JSX.Element {
  return (
    <div class="count">
      <span class="counts">
        {props.count}/{props.of}
      </span>
      <span class="range-words">{percentRange(props.interval)}</span>
      <IntervalBar share={props.count / props.of} interval={props.interval} />
    </div>
  );
}

const ABOUT: readonly Column<EvaluationCell>[] = [
  { name: 'Controller', isHead: true, cell: controllerLabel },
  { name: 'Map', cell: ({ map }) => map },
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
    name: 'Error, mean',
    unit: 'cm',
    title: 'Distance between tool and bead during transport, mean over the episodes',
    ...centimetres('tracking_error_mean_m'),
  },
  {
    name: 'max x',
    unit: 'cm',
    title: 'Largest difference in x during transport, mean over the episodes',
    ...centimetres('tracking_error_max_x_m'),
  },
  {
    name: 'max y',
    unit: 'cm',
    title: 'Largest difference in y during transport, mean over the episodes',
    ...centimetres('tracking_error_max_y_m'),
  },
  {
    name: 'Path ÷ shortest',
    title:
      "Length of the tool's path while it carries the bead, divided by the shortest possible path of the bead; mean over the episodes that delivered",
    cell: (row) => ratio(row.path_ratio_mean),
  },
  {
    name: 'Steps',
    title: 'Control steps, mean over the episodes',
    cell: (row) => fixed(row.steps_mean, 1),
  },
  {
    name: 'Switches',
    title: 'Switches of the active sub-controller, mean over the episodes',
    cell: (row) => fixed(row.switches_mean, 2),
  },
  {
    name: 'Decision',
    unit: 'ms, p50 · p99',
    title:
      'Computing time of a control step with its camera image: median and 99th percentile, including all other work of this machine',
    cell: decisionWords,
  },
];

function reached({ successes, episodes, successes_wilson95 }: Common): JSX.Element {
  return <Share count={successes} of={episodes} interval={successes_wilson95} />;
}

/** A number that the paper has, too. */
function centimetres(name: `tracking_error_${'mean' | 'max_x' | 'max_y'}_m`) {
  const cell = (row: Common): string => cm(row[name]);
  return { cell, paper: cell };
}

/** A cell whose row has not arrived. */
function pendingWords({ done, delivered }: EvaluationCell, summary: EvaluationSummary): string {
  const hasEnded = !isActive(summary);
  if (done === 0) return hasEnded ? 'not started' : 'waiting';
  const counted = `${done} of ${summary.query.episodes} episodes, ${delivered} delivered`;
  return hasEnded ? `stopped after ${counted}` : `${counted} so far`;
}

function Paper(props: { paper: PaperRow }): JSX.Element {
  return (
    <tr class="paper">
      <th scope="row" colspan="3">
        paper, {props.paper.section}: “{props.paper.printed}”
      </th>
      <For each={MEASURED}>
        {({ paper }) => (paper ? <td>{paper(props.paper)}</td> : <td class="none">–</td>)}
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
      <table class="results number">
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
                <Show when={cell().paper}>{(paper) => <Paper paper={paper()} />}</Show>
              </>
            )}
          </Index>
        </tbody>
      </table>
    </div>
  );
}

// The rows as they arrive. The paper's numbers are below the rows that have them.

import { For, Show, type JSX } from 'solid-js';
import { fixed } from '../../ui/format';
import { controllerLabel } from '../../lab/parameters';
import type { EvaluationCell, EvaluationSummary, PaperRow, Row } from '../../net/protocol.gen';
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
    <td class="count">
      <span class="counts">
        {props.count}/{props.of}
      </span>
      <span class="range-words">{percentRange(props.interval)}</span>
      <IntervalBar share={props.count / props.of} interval={props.interval} />
    </td>
  );
}

function Head(props: { name: string; unit?: string; title: string }): JSX.Element {
  return (
    <th scope="col" title={props.title}>
      {props.name}
      <Show when={props.unit}>
        {(unit) => (
          <>
            <br />
            <span class="unit">{unit()}</span>
          </>
        )}
      </Show>
    </th>
  );
}

function Ours(props: { row: Row }): JSX.Element {
  return (
    <>
      <Share
        count={props.row.successes}
        of={props.row.episodes}
        interval={props.row.successes_wilson95}
      />
      <Share count={props.row.delivered} of={props.row.episodes} interval={props.row.wilson95} />
      <td>{cm(props.row.tracking_error_mean_m)}</td>
      <td>{cm(props.row.tracking_error_max_x_m)}</td>
      <td>{cm(props.row.tracking_error_max_y_m)}</td>
      <td>{ratio(props.row.path_ratio_mean)}</td>
      <td>{fixed(props.row.steps_mean, 1)}</td>
      <td>{fixed(props.row.switches_mean, 2)}</td>
      <td>{decisionWords(props.row)}</td>
    </>
  );
}

/** A cell whose row has not arrived. */
function Pending(props: { cell: EvaluationCell; summary: EvaluationSummary }): JSX.Element {
  const words = (): string => {
    const { done, delivered } = props.cell;
    const { stage, query } = props.summary;
    const ended = stage !== 'running' && stage !== 'waiting';
    if (done === 0) return ended ? 'not started' : 'waiting';
    const counted = `${done} of ${query.episodes} episodes, ${delivered} delivered`;
    return ended ? `stopped after ${counted}` : `${counted} so far`;
  };
  return (
    <td class="pending" colspan="9">
      {words()}
    </td>
  );
}

function Paper(props: { paper: PaperRow }): JSX.Element {
  return (
    <tr class="paper">
      <th scope="row" colspan="3">
        paper, {props.paper.section}: “{props.paper.printed}”
      </th>
      <Share
        count={props.paper.successes}
        of={props.paper.episodes}
        interval={props.paper.successes_wilson95}
      />
      <td class="none">–</td>
      <td>{cm(props.paper.tracking_error_mean_m)}</td>
      <td>{cm(props.paper.tracking_error_max_x_m)}</td>
      <td>{cm(props.paper.tracking_error_max_y_m)}</td>
      <td class="none">–</td>
      <td class="none">–</td>
      <td class="none">–</td>
      <td class="none">–</td>
    </tr>
  );
}

export function EvaluationTable(props: {
  summary: EvaluationSummary;
  rows: readonly Row[];
}): JSX.Element {
  const isVaried = (): boolean => props.summary.query.vary.length > 0;
  // Keyed by number, so that new data changes a row's content and does not replace the row.
  const numbers = (): number[] => props.summary.cells.map((_, index) => index);
  return (
    <div class="table-frame" tabindex="0" role="region" aria-label="Results">
      <table class="results number">
        <thead>
          <tr>
            <th scope="col">Controller</th>
            <th scope="col">Map</th>
            <Show when={isVaried()}>
              <th scope="col">Varied</th>
            </Show>
            <th scope="col" title="Scripted disturbances per episode">
              Dist.
            </th>
            <Head
              name="Reached"
              unit="95 % Wilson"
              title="The tool came within 2 cm of the goal, as in the paper"
            />
            <Head
              name="Delivered"
              unit="95 % Wilson"
              title="The bead came within 2 cm of the goal, released, within 5 s after the tool"
            />
            <Head
              name="Error, mean"
              unit="cm"
              title="Distance between tool and bead during transport, mean over the episodes"
            />
            <Head
              name="max x"
              unit="cm"
              title="Largest difference in x during transport, mean over the episodes"
            />
            <Head
              name="max y"
              unit="cm"
              title="Largest difference in y during transport, mean over the episodes"
            />
            <Head
              name="Path ÷ shortest"
              title="Length of the tool's path while it carries the bead, divided by the shortest possible path of the bead; mean over the episodes that delivered"
            />
            <Head name="Steps" title="Control steps, mean over the episodes" />
            <Head
              name="Switches"
              title="Switches of the active sub-controller, mean over the episodes"
            />
            <Head
              name="Decision"
              unit="ms, p50 · p99"
              title="Computing time of a control step with its camera image: median and 99th percentile, including all other work of this machine"
            />
          </tr>
        </thead>
        <tbody>
          <For each={numbers()}>
            {(index) => (
              <Show when={props.summary.cells[index]}>
                {(cell) => (
                  <>
                    <tr data-testid="evaluation-row">
                      <th scope="row">{controllerLabel(cell())}</th>
                      <td>{cell().map}</td>
                      <Show when={isVaried()}>
                        <td>{variedWords(cell().varied)}</td>
                      </Show>
                      <td>{cell().disturbances}</td>
                      <Show
                        when={props.rows[index]}
                        fallback={<Pending cell={cell()} summary={props.summary} />}
                      >
                        {(row) => <Ours row={row()} />}
                      </Show>
                    </tr>
                    <Show when={cell().paper}>{(paper) => <Paper paper={paper()} />}</Show>
                  </>
                )}
              </Show>
            )}
          </For>
        </tbody>
      </table>
    </div>
  );
}

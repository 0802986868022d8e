// Trials whose bead was not delivered. Each can be set up again.

import { For, Show, createMemo, createSignal, type JSX } from 'solid-js';
import { controllerLabel } from '../../lab/parameters';
import type { EvaluationFailure, EvaluationReport } from '../../net/protocol.gen';
import { setUpAgain } from './setUp';
import { reason } from './table';
import { variedWords } from './varied';
import type { Session, Trial } from '../../lab/slices';
import './tables.css';

/** Number of failures shown at first and added per click: a controller may fail a thousand times. */
const PAGE = 50;

function FailureRow(props: {
  lab: Session & Trial;
  report: EvaluationReport;
  failure: EvaluationFailure;
  onLaboratory: () => void;
}): JSX.Element {
  const { lab } = props;
  const cell = () => props.report.cells[props.failure.cell];
  const label = (): string => {
    const now = cell();
    if (!now) return '';
    const { map, disturbances, varied } = now;
    return [controllerLabel(now), map, disturbances, variedWords(varied)]
      .filter((word) => word !== '')
      .join(', ');
  };
  const setUp = async (): Promise<void> => {
    const now = cell();
    const defaults = lab.scene()?.defaults;
    if (!now || !defaults) return;
    props.onLaboratory();
    const parameters = { ...defaults, rl_policy: props.report.query.rl_policy };
    const { kind } = await lab.send('playback', setUpAgain(now, props.failure, parameters));
    if (kind === 'done' && now.program !== null) {
      const { program } = now;
      await lab.send('controller', { type: 'select_controller', controller: 'program', program });
    }
  };
  return (
    <tr>
      <th scope="row">{props.failure.index}</th>
      <td>{label()}</td>
      <td class="failure-why">{reason(props.failure)}</td>
      <td>{props.failure.steps}</td>
      <td>
        <button
          type="button"
          class="small"
          disabled={!lab.canOperate()}
          aria-label={`Set it up: episode ${props.failure.index} of ${label()}`}
          title="Loads this episode into the live session"
          onClick={() => void setUp()}
        >
          Set it up
        </button>
      </td>
    </tr>
  );
}

export function FailureList(props: {
  lab: Session & Trial;
  report: EvaluationReport;
  onLaboratory: () => void;
}): JSX.Element {
  const [shown, setShown] = createSignal(PAGE);
  const failures = createMemo(() => props.report.failures.slice(0, shown()));
  return (
    <Show
      when={failures().length > 0}
      fallback={
        <p class="placeholder">
          {props.report.rows.length > 0
            ? 'No failures: every bead in these rows was delivered.'
            : 'No failures yet. They appear with the rows.'}
        </p>
      }
    >
      <div class="table-frame" tabindex="0" role="region" aria-label="Failures">
        <table class="failures number">
          <thead>
            <tr>
              <th scope="col">Episode</th>
              <th scope="col">Controller, map, disturbances</th>
              <th scope="col">Reason</th>
              <th scope="col">Steps</th>
              <th scope="col">
                <span class="visually-hidden">Set up</span>
              </th>
            </tr>
          </thead>
          <tbody>
            <For each={failures()}>
              {(failure) => (
                <FailureRow
                  lab={props.lab}
                  report={props.report}
                  failure={failure}
                  onLaboratory={props.onLaboratory}
                />
              )}
            </For>
          </tbody>
        </table>
      </div>
      <Show when={props.report.failures.length > shown()}>
        <button
          type="button"
          class="small more"
          onClick={() => {
            setShown(shown() + PAGE);
          }}
        >
          Show more of {props.report.failures.length}
        </button>
      </Show>
    </Show>
  );
}

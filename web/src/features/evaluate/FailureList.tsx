// Trials whose bead was not delivered. Each can be set up again.

import { Show, createSignal, type JSX } from 'solid-js';
import { operatorOnly } from '../../lab/operatorOnly';
import { controllerLabel } from '../../lab/parameters';
import type { EvaluationFailure, EvaluationReport } from '../../net/protocol.gen';
import { SmallButton } from '../../ui/SmallButton';
import { type Column, Table } from '../../ui/Table';
import { setUpAgain } from './setUp';
import { reason } from './table';
import { variedWords } from './varied';
import type { Addressed, Session, Trial } from '../../lab/slices';
import './tables.css';

/** Number of failures shown at first and added per click: a controller may fail a thousand times. */
const PAGE = 50;

export function FailureList(props: {
  lab: Addressed & Session & Trial;
  report: EvaluationReport;
}): JSX.Element {
  const { lab } = props;
  const [shown, setShown] = createSignal(PAGE);
  const label = ({ cell }: EvaluationFailure): string => {
    const now = props.report.cells[cell];
    if (!now) return '';
    const { map, disturbances, varied } = now;
    return [controllerLabel(now), map, disturbances, variedWords(varied)]
      .filter((word) => word !== '')
      .join(', ');
  };
  const setUp = async (failure: EvaluationFailure): Promise<void> => {
    const now = props.report.cells[failure.cell];
    const defaults = lab.scene()?.defaults;
    if (!now || !defaults) return;
    lab.address.show('laboratory');
    const parameters = { ...defaults, rl_policy: props.report.query.rl_policy };
    const { kind } = await lab.send('playback', setUpAgain(now, failure, parameters));
    if (kind === 'done' && now.program !== null) {
      const { program } = now;
      await lab.send('controller', { type: 'select_controller', controller: 'program', program });
    }
  };
  const columns: readonly Column<EvaluationFailure>[] = [
    { name: 'Episode', isHead: true, cell: ({ index }) => index },
    { name: 'Controller, map, disturbances', cell: label },
    { name: 'Reason', cell: reason },
    { name: 'Steps', cell: ({ steps }) => steps },
    {
      name: 'Set up',
      hideName: true,
      cell: (failure) => (
        <SmallButton
          {...operatorOnly(lab, 'Loads this episode into the live session')}
          aria-label={`Set it up: episode ${failure.index} of ${label(failure)}`}
          onClick={() => void setUp(failure)}
        >
          Set it up
        </SmallButton>
      ),
    },
  ];
  return (
    <Show
      when={props.report.failures.length > 0}
      fallback={
        <p class="placeholder">
          {props.report.rows.length > 0
            ? 'No failures: every bead in these rows was delivered.'
            : 'No failures yet. They appear with the rows.'}
        </p>
      }
    >
      <div class="table-frame" tabindex="0" role="region" aria-label="Failures">
        <Table
          class="data-table failures"
          columns={columns}
          rows={props.report.failures.slice(0, shown())}
        />
      </div>
      <Show when={props.report.failures.length > shown()}>
        <SmallButton class="small more" onClick={() => setShown(shown() + PAGE)}>
          Show more of {props.report.failures.length}
        </SmallButton>
      </Show>
    </Show>
  );
}

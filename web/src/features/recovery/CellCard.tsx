// The trials of a cell: each can be set up in the session or saved as a test case.

import { For, Show, createEffect, createSignal, on, type JSX } from 'solid-js';
import { CommandButton } from '../../lab/CommandButton';
import type { Notices, Session } from '../../lab/slices';
import { get, getText } from '../../net/requests';
import type { RecoveryReport, RecoveryTrial, RecoveryTrials } from '../../net/protocol.gen';
import { messageOf } from '../../ui/attempt';
import { download } from '../../ui/download';
import { SmallButton } from '../../ui/SmallButton';
import { cellWords, rowsOf, spotWords, trialWords } from './cells';
import { PATH } from './recoveries';
import type { Chosen } from './store';

export function CellCard(props: {
  lab: Session & Notices;
  report: RecoveryReport;
  chosen: Required<Chosen>;
  label: string;
}): JSX.Element {
  let card: HTMLElement | undefined;
  const [trials, setTrials] = createSignal<readonly RecoveryTrial[]>([]);
  const row = () =>
    rowsOf(props.report, props.chosen.name).find(({ cell }) => cell === props.chosen.cell);
  const controller = () => props.report.controllers[props.report.names.indexOf(props.chosen.name)];
  const say = (reason: unknown): void => {
    props.lab.notify('recovery', messageOf(reason));
  };
  createEffect(
    on([() => `${props.report.id}/cells/${props.chosen.cell}`, () => row()?.repeats], ([path]) => {
      get<RecoveryTrials>(`${PATH}/${path}`)
        .then((answer) => {
          setTrials(answer.trials);
          // It lies below the figure, and the press may have been on the map.
          card?.scrollIntoView({ block: 'nearest' });
        })
        .catch(say);
    }),
  );
  const own = () => trials().filter((trial) => trial.controller === controller());
  const save = (trial: RecoveryTrial): void => {
    const { cell } = props.chosen;
    const path = `${props.report.id}/cells/${cell}/${trial.controller}/${trial.repeat}/case.json`;
    getText(`${PATH}/${path}`)
      .then((text) => {
        const name = `${props.report.id}-cell-${cell}-${trial.controller}-${trial.repeat}.json`;
        download(name, new Blob([text], { type: 'application/json' }));
      })
      .catch(say);
  };
  return (
    <Show when={row()}>
      {(row) => (
        <section ref={card} class="recovery-card" aria-label="The chosen cell">
          <h3>The chosen cell</h3>
          <p>
            <strong>{props.label}</strong>, {spotWords(row(), props.report.kind)}:{' '}
            <span data-testid="recovery-cell">{cellWords(row())}</span>.
          </p>
          <ul>
            <For each={own()}>
              {(trial) => (
                <li>
                  <span>{trialWords(trial)}</span>
                  <CommandButton
                    lab={props.lab}
                    at="recovery"
                    class="small"
                    aria-label={`Set up trial ${trial.repeat + 1}`}
                    title="Goes to the moment and sets this trial up, exactly; Run plays it. The present is kept as a run."
                    command={() => ({
                      type: 'open_try',
                      recovery: props.report.id,
                      cell: props.chosen.cell,
                      controller: trial.controller,
                      repeat: trial.repeat,
                    })}
                  >
                    Set up
                  </CommandButton>
                  <SmallButton
                    aria-label={`Save trial ${trial.repeat + 1} as a test case`}
                    onClick={() => {
                      save(trial);
                    }}
                  >
                    Save
                  </SmallButton>
                </li>
              )}
            </For>
          </ul>
        </section>
      )}
    </Show>
  );
}

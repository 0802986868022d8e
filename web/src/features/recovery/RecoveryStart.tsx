// Chooses what is tried from the shown moment, and starts a recovery map.

import { Shield } from 'lucide';
import { createMemo, For, Show, type JSX } from 'solid-js';
import { paceOf } from '../../lab/jobs';
import { createTakingPart } from '../../lab/offered';
import type { Session, Trial } from '../../lab/slices';
import { RECOVERY_FIELDS } from '../../net/forms.gen';
import { addressOf } from '../../net/base';
import type { RecoveryKind, RecoveryReport } from '../../net/protocol.gen';
import { CheckField, ChoiceField, NumberField } from '../../ui/fields/fields';
import { Form } from '../../ui/fields/Form';
import { numberOf } from '../../ui/fields/number';
import { clock, counted, roughly } from '../../ui/format';
import { KIND_WORDS } from './cells';
import { startRecovery } from './recoveries';
import { cellsMost } from './size';
import { change, draft, edits } from './store';

const KINDS = Object.entries(KIND_WORDS) as [RecoveryKind, string][];
const COLUMNS: Readonly<Record<RecoveryKind, string>> = {
  place: 'Columns',
  push: 'Directions',
  drag: 'Directions',
  blind: 'Times',
};

const FILES = [
  ['html', 'HTML'],
  ['csv', 'CSV'],
] as const;

export function RecoveryStart(props: {
  lab: Session & Trial;
  /** Offered as files once a trial has ended. */
  report: RecoveryReport | undefined;
}): JSX.Element {
  const { lab } = props;
  const { wanted, field } = createTakingPart(
    lab,
    () => draft().left_out,
    (left_out) => {
      change({ left_out });
    },
  );
  const trials = createMemo((): number => {
    const { kind, grid, repeats } = draft();
    const [columns, scene] = [numberOf(grid), lab.scene()];
    const { max } = RECOVERY_FIELDS.grid;
    // What is typed may be no number yet, or a huge one.
    if (!scene || !(columns > 0 && columns <= max) || !Number.isInteger(columns)) return NaN;
    return cellsMost(kind, columns, scene) * wanted().length * numberOf(repeats);
  });
  const size = (): string => {
    const count = `${draft().kind === 'place' ? 'At most ' : ''}${counted(trials(), 'trial')}`;
    const time_s = trials() * paceOf(lab.catalog, 'recovery');
    return Number.isNaN(time_s) ? count : `${count}, about ${roughly(time_s)}`;
  };
  const start = async (): Promise<void> => {
    const [tick, map] = [lab.state()?.tick, lab.scene()?.map];
    if (tick === undefined || map === undefined) return;
    const { kind, grid, repeats, within_s, seed } = draft();
    const query = {
      session: lab.session,
      tick,
      kind,
      controllers: wanted(),
      grid: numberOf(grid),
      repeats: numberOf(repeats),
      seed: numberOf(seed),
      within_s: numberOf(within_s),
      full: false,
    };
    await startRecovery(query, map);
  };
  return (
    <Form
      class="recovery-start"
      byButtonOnly
      send={start}
      button={`Map from ${clock(lab.state()?.sim_time_s ?? 0)}`}
      icon={Shield}
      isFoot
      buttonTitle="Tries each disturbance from the shown moment under each controller, beside the session"
      disabled={!lab.canOperate()}
      beside={
        <>
          <For each={(props.report?.done ?? 0) > 0 && FILES}>
            {([ending, name]) => (
              <a
                class="button small ghost"
                href={addressOf(`/api/recoveries/${props.report?.id ?? ''}/map.${ending}`)}
                download=""
              >
                {name}
              </a>
            )}
          </For>
          <Show when={trials() > 0}>
            <span class="hint" data-testid="recovery-size">
              {size()}
            </span>
          </Show>
        </>
      }
    >
      <div class="form-two">
        <ChoiceField {...edits('kind')} label="Disturbance" options={KINDS} />
        <NumberField {...RECOVERY_FIELDS.grid} {...edits('grid')} label={COLUMNS[draft().kind]} />
        <NumberField {...RECOVERY_FIELDS.repeats} {...edits('repeats')} />
        <NumberField {...RECOVERY_FIELDS.within_s} {...edits('within_s')} />
        <NumberField {...edits('seed')} label="Noise seed" min={0} isWhole />
      </div>
      <CheckField {...field} verb="Try" />
    </Form>
  );
}

// Chooses what is tried from the shown moment, and starts a recovery map.

import { Show, type JSX } from 'solid-js';
import { createTakingPart } from '../../lab/offered';
import { operatorOnly } from '../../lab/operatorOnly';
import type { Session, Trial } from '../../lab/slices';
import { isActive } from '../../lab/trainingStage';
import { RECOVERY_FIELDS } from '../../net/forms.gen';
import type { RecoveryKind, RecoverySummary } from '../../net/protocol.gen';
import { createAttempt } from '../../ui/attempt';
import { CheckField, ChoiceField, NumberField } from '../../ui/fields/fields';
import { Form } from '../../ui/fields/Form';
import { numberOf } from '../../ui/fields/number';
import { clock } from '../../ui/format';
import { SmallButton } from '../../ui/SmallButton';
import { cancelRecovery, startRecovery } from './recoveries';
import { change, draft, edits } from './store';

const KINDS: readonly (readonly [RecoveryKind, string])[] = [
  ['place', 'put the bead elsewhere'],
  ['push', 'push the bead'],
  ['drag', 'pull the bead by hand'],
  ['blind', 'blind the tracker'],
];
const COLUMNS: Readonly<Record<RecoveryKind, string>> = {
  place: 'Columns',
  push: 'Directions',
  drag: 'Directions',
  blind: 'Times',
};

export function RecoveryStart(props: {
  lab: Session & Trial;
  shown: RecoverySummary | undefined;
}): JSX.Element {
  const { lab } = props;
  const { attempt, refusal } = createAttempt();
  const { wanted, field } = createTakingPart(
    lab,
    () => draft().left_out,
    (left_out) => {
      change({ left_out });
    },
  );
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
      isInline
      byButtonOnly
      send={start}
      button={`Map recovery from ${clock(lab.state()?.sim_time_s ?? 0)}`}
      buttonClass="small primary"
      buttonTitle="Tries each disturbance from the shown moment under each controller, beside the session"
      disabled={!lab.canOperate()}
      beside={
        <>
          <Show when={props.shown && isActive(props.shown) && props.shown.id}>
            {(id) => (
              <SmallButton
                {...operatorOnly(lab)}
                onClick={() => void attempt(cancelRecovery(id()))}
              >
                Cancel map
              </SmallButton>
            )}
          </Show>
          <span class="refusal" role="alert">
            {refusal()}
          </span>
        </>
      }
    >
      <ChoiceField {...edits('kind')} label="Disturbance" options={KINDS} />
      <NumberField {...RECOVERY_FIELDS.grid} {...edits('grid')} label={COLUMNS[draft().kind]} />
      <NumberField {...RECOVERY_FIELDS.repeats} {...edits('repeats')} />
      <NumberField {...RECOVERY_FIELDS.within_s} {...edits('within_s')} />
      <NumberField {...edits('seed')} label="Noise seed" min={0} isWhole />
      <CheckField {...field} verb="Try" />
    </Form>
  );
}

// Chooses what is tried from the shown moment, and starts a recovery map.

import { Show, createSignal, type JSX } from 'solid-js';
import { createOffered } from '../../lab/offered';
import type { Session, Trial } from '../../lab/slices';
import { RECOVERY_FIELDS } from '../../net/forms.gen';
import type { ControllerName, RecoveryKind } from '../../net/protocol.gen';
import { CheckField, ChoiceField, NumberField } from '../../ui/fields/fields';
import { Form } from '../../ui/fields/Form';
import { numberOf } from '../../ui/fields/number';
import { clock } from '../../ui/format';
import { type RecoveryList, isActive } from './recoveries';
import { type Draft, store } from './store';

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

export function RecoveryStart(props: { lab: Session & Trial; list: RecoveryList }): JSX.Element {
  const { lab } = props;
  /** Why the map could not be cancelled. */
  const [refusal, setRefusal] = createSignal<string>();
  const { draft } = store;
  const change = (part: Partial<Draft>): void => {
    store.setDraft({ ...draft(), ...part });
  };
  const { offered, label } = createOffered(lab);
  const wanted = (): ControllerName[] =>
    offered().filter((name) => !draft().left_out.includes(name));
  const start = async (): Promise<void> => {
    const tick = lab.state()?.tick;
    if (tick === undefined) return;
    setRefusal(undefined);
    const { kind, grid, repeats, within_s, seed } = draft();
    await props.list.start({
      session: lab.session,
      tick,
      kind,
      controllers: wanted(),
      grid: numberOf(grid),
      repeats: numberOf(repeats),
      seed: numberOf(seed),
      within_s: numberOf(within_s),
      full: false,
    });
  };
  const cancel = async (id: string): Promise<void> => {
    try {
      await props.list.cancel(id);
    } catch (reason) {
      setRefusal(reason instanceof Error ? reason.message : String(reason));
    }
  };
  const running = (): string | undefined => {
    const shown = props.list.shown();
    return shown && isActive(shown) ? shown.id : undefined;
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
          <Show when={running()}>
            {(id) => (
              <button
                type="button"
                class="small"
                disabled={!lab.canOperate()}
                onClick={() => void cancel(id())}
              >
                Cancel map
              </button>
            )}
          </Show>
          <span class="refusal" role="alert">
            {refusal()}
          </span>
        </>
      }
    >
      <ChoiceField
        name="kind"
        label="Disturbance"
        value={draft().kind}
        options={KINDS}
        onChoose={(kind) => {
          change({ kind });
        }}
      />
      <NumberField
        {...RECOVERY_FIELDS.grid}
        label={COLUMNS[draft().kind]}
        value={draft().grid}
        onInput={(grid) => {
          change({ grid });
        }}
      />
      <NumberField
        {...RECOVERY_FIELDS.repeats}
        value={draft().repeats}
        onInput={(repeats) => {
          change({ repeats });
        }}
      />
      <NumberField
        {...RECOVERY_FIELDS.within_s}
        value={draft().within_s}
        onInput={(within_s) => {
          change({ within_s });
        }}
      />
      <NumberField
        name="seed"
        label="Noise seed"
        min={0}
        isWhole
        value={draft().seed}
        onInput={(seed) => {
          change({ seed });
        }}
      />
      <CheckField
        name="controllers"
        label="Controllers"
        hideLabel
        verb="Try"
        missing="Choose at least one controller."
        all={offered()}
        chosen={wanted()}
        text={label}
        onChoose={(names) => {
          change({ left_out: offered().filter((name) => !names.includes(name)) });
        }}
      />
    </Form>
  );
}

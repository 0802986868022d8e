// Chooses what is tried from the shown moment, and starts a recovery map.

import { Show, createSignal, type JSX } from 'solid-js';
import { ControllerChecks, createOffered } from '../../lab/ControllerChecks';
import type { Session, Trial } from '../../lab/slices';
import type { ControllerName, RecoveryKind } from '../../net/protocol.gen';
import { clock } from '../../ui/format';
import { numberFault, numberOf } from '../../ui/number';
import { NumberInput } from '../../ui/NumberInput';
import { ServerSelect } from '../../ui/ServerSelect';
import { type RecoveryList, isActive } from './recoveries';
import { store } from './store';

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

function Whole(props: {
  label: string;
  value: string;
  onInput: (value: string) => void;
}): JSX.Element {
  return (
    <label class="recovery-number">
      {props.label}
      <NumberInput min={0} value={props.value} onInput={props.onInput} />
    </label>
  );
}

export function RecoveryStart(props: { lab: Session & Trial; list: RecoveryList }): JSX.Element {
  const { lab } = props;
  const [refusal, setRefusal] = createSignal<string>();
  const { draft, setDraft } = store;
  const { offered, label } = createOffered(lab);
  const wanted = (): ControllerName[] =>
    offered().filter((name) => !draft().left_out.includes(name));
  const start = async (): Promise<void> => {
    const tick = lab.state()?.tick;
    if (tick === undefined) return;
    const { kind, grid, repeats, within_s, seed } = draft();
    const wrong = [grid, repeats, within_s, seed].find((text) => numberFault(text) !== undefined);
    setRefusal(wrong === undefined ? undefined : numberFault(wrong));
    if (wrong !== undefined) return;
    try {
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
    } catch (reason) {
      setRefusal(reason instanceof Error ? reason.message : String(reason));
    }
  };
  const running = (): string | undefined => {
    const shown = props.list.shown();
    return shown && isActive(shown) ? shown.id : undefined;
  };
  return (
    <div class="recovery-start">
      <ServerSelect
        label="Disturbance"
        value={draft().kind}
        options={KINDS}
        disabled={false}
        onChoose={(value) => {
          const kind = KINDS.find(([name]) => name === value)?.[0];
          if (kind) setDraft({ ...draft(), kind });
        }}
      />
      <Whole
        label={COLUMNS[draft().kind]}
        value={draft().grid}
        onInput={(grid) => setDraft({ ...draft(), grid })}
      />
      <Whole
        label="Repeats"
        value={draft().repeats}
        onInput={(repeats) => setDraft({ ...draft(), repeats })}
      />
      <Whole
        label="In time, s"
        value={draft().within_s}
        onInput={(within_s) => setDraft({ ...draft(), within_s })}
      />
      <Whole
        label="Noise seed"
        value={draft().seed}
        onInput={(seed) => setDraft({ ...draft(), seed })}
      />
      <ControllerChecks
        verb="Try"
        offered={offered()}
        label={label}
        isChosen={(name) => !draft().left_out.includes(name)}
        onToggle={(name, on) => {
          const others = draft().left_out.filter((one) => one !== name);
          setDraft({ ...draft(), left_out: on ? others : [...others, name] });
        }}
      />
      <button
        type="button"
        class="small primary"
        disabled={!lab.canOperate() || wanted().length === 0}
        title="Tries each disturbance from the shown moment under each controller, beside the session"
        onClick={() => void start()}
      >
        Map recovery from {clock(lab.state()?.sim_time_s ?? 0)}
      </button>
      <Show when={running()}>
        {(id) => (
          <button
            type="button"
            class="small"
            disabled={!lab.canOperate()}
            onClick={() => {
              props.list.cancel(id()).catch((reason: unknown) => {
                setRefusal(reason instanceof Error ? reason.message : String(reason));
              });
            }}
          >
            Cancel map
          </button>
        )}
      </Show>
      <div role="alert">
        <Show when={refusal()}>{(text) => <p class="refusal">{text()}</p>}</Show>
      </div>
    </div>
  );
}

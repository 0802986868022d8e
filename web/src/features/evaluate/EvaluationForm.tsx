// The form for a new evaluation.

import { For, Show, createMemo, createSignal, createUniqueId, type JSX } from 'solid-js';
import {
  CONTROLLERS,
  CONTROLLER_LABELS,
  FIELDS,
  type PolicyField,
  policyOptions,
} from '../../lab/parameters';
import { createPrograms } from '../../lab/programs';
import type { EvaluationSummary } from '../../net/protocol.gen';
import { Refusal } from '../../net/requests';
import { roughly } from '../../ui/format';
import { NumberInput } from '../../ui/NumberInput';
import { startEvaluation } from './evaluations';
import { draft, setDraft } from './draft';
import {
  chooseControllers,
  type Draft,
  estimate_s,
  type Faults,
  faultsOf,
  type Field,
  queryOf,
  sizeWords,
  toggled,
} from './request';
import type { Session, Trial } from '../../lab/slices';
import { VaryFields } from './VaryFields';
import { shownName } from '../../ui/name';
import './EvaluationForm.css';

const DISTURBANCES = [0, 3] as const;
const LABELS = new Map<string, string>(Object.entries(CONTROLLER_LABELS));

function Fault(props: { id: string; text: string | undefined }): JSX.Element {
  return (
    <div id={props.id} role="alert">
      <Show when={props.text}>{(text) => <p class="refusal">{text()}</p>}</Show>
    </div>
  );
}

function Choice<T extends string | number>(props: {
  legend: string;
  all: readonly T[];
  chosen: readonly T[];
  label?: (item: T) => string;
  fault: string | undefined;
  onChoose: (chosen: T[]) => void;
}): JSX.Element {
  const id = createUniqueId();
  return (
    <fieldset class="boxes" aria-describedby={id}>
      <legend>{props.legend}</legend>
      <div class="box-row">
        <For each={props.all}>
          {(item) => (
            <label>
              <input
                type="checkbox"
                checked={props.chosen.includes(item)}
                onChange={({ currentTarget }) => {
                  props.onChoose(toggled(props.all, props.chosen, item, currentTarget.checked));
                }}
              />
              {props.label?.(item) ?? item}
            </label>
          )}
        </For>
      </div>
      <Fault id={id} text={props.fault} />
    </fieldset>
  );
}

function Policy(props: {
  added: readonly string[];
  value: string;
  fault: string | undefined;
  onInput: (value: string) => void;
}): JSX.Element {
  const id = createUniqueId();
  const fault = createUniqueId();
  const options = createMemo(() => {
    const field = FIELDS.find((one): one is PolicyField => one.kind === 'policy');
    return field ? policyOptions(field, props.added, props.value) : [];
  });
  return (
    <div>
      <div class="field">
        <label for={id}>Policy of RL</label>
        <select
          id={id}
          aria-invalid={props.fault !== undefined}
          aria-describedby={fault}
          onChange={({ currentTarget }) => {
            props.onInput(currentTarget.value);
          }}
        >
          <For each={options()}>
            {([value, label]) => (
              <option value={value} selected={value === props.value}>
                {label}
              </option>
            )}
          </For>
        </select>
      </div>
      <Fault id={fault} text={props.fault} />
    </div>
  );
}

function Whole(props: {
  label: string;
  value: string;
  fault: string | undefined;
  onInput: (value: string) => void;
}): JSX.Element {
  const id = createUniqueId();
  const fault = createUniqueId();
  return (
    <div class="whole">
      <div class="field">
        <label for={id}>{props.label}</label>
        <NumberInput
          id={id}
          min={0}
          isWhole
          value={props.value}
          isInvalid={props.fault !== undefined}
          describedBy={fault}
          onInput={props.onInput}
        />
      </div>
      <Fault id={fault} text={props.fault} />
    </div>
  );
}

export function EvaluationForm(props: {
  lab: Session & Trial;
  measured: readonly EvaluationSummary[];
  onStarted: (id: string) => void;
}): JSX.Element {
  const { lab } = props;
  const [faults, setFaults] = createSignal<Faults>({});
  const [busy, setBusy] = createSignal(false);
  const programs = createPrograms(lab.catalog, () => draft().program || undefined);
  // A changed field loses its error message.
  const change = (field: Field, part: Partial<Draft>): void => {
    setDraft({ ...draft(), ...part });
    setFaults({ ...faults(), [field]: undefined, form: undefined });
  };
  const scope = (): string => {
    const made = queryOf(draft());
    if ('faults' in made) return '';
    const time_s = estimate_s(made.query, props.measured);
    const estimate = time_s === undefined ? 'duration not known yet' : `about ${roughly(time_s)}`;
    return `${sizeWords(made.query)}; ${estimate}.`;
  };
  const start = async (): Promise<void> => {
    const made = queryOf(draft());
    if ('faults' in made) {
      setFaults(made.faults);
      return;
    }
    setFaults({});
    setBusy(true);
    try {
      props.onStarted(await startEvaluation(made.query));
    } catch (reason) {
      setFaults(reason instanceof Refusal ? faultsOf(reason) : { form: String(reason) });
    } finally {
      setBusy(false);
    }
  };
  return (
    <form
      class="evaluation-form"
      novalidate
      onSubmit={(event) => {
        event.preventDefault();
        // Enter in a field submits the form even when the button is disabled.
        if (lab.canOperate() && !busy()) void start();
      }}
    >
      <Choice
        legend="Controllers"
        all={[...CONTROLLERS, ...programs()]}
        chosen={[...draft().controllers, draft().program]}
        label={(name) => LABELS.get(name) ?? shownName(name)}
        fault={faults().controllers}
        onChoose={(chosen) => {
          change('controllers', chooseControllers(chosen, draft().program));
        }}
      />
      <Show when={draft().controllers.includes('rl')}>
        <Policy
          added={lab.catalog.addedPolicies()}
          value={draft().rl_policy}
          fault={faults().rl_policy}
          onInput={(rl_policy) => {
            change('rl_policy', { rl_policy });
          }}
        />
      </Show>
      <Choice
        legend="Maps"
        all={lab.catalog.maps() ?? []}
        chosen={draft().maps}
        fault={faults().maps}
        onChoose={(maps) => {
          change('maps', { maps });
        }}
      />
      <Choice
        legend="Disturbances per episode"
        all={DISTURBANCES}
        chosen={draft().disturbances}
        fault={faults().disturbances}
        onChoose={(disturbances) => {
          change('disturbances', { disturbances });
        }}
      />
      <VaryFields
        value={draft().vary}
        fault={faults().vary}
        onInput={(vary) => {
          change('vary', { vary });
        }}
      />
      <div class="wholes">
        <Whole
          label="Episodes per cell"
          value={draft().episodes}
          fault={faults().episodes}
          onInput={(episodes) => {
            change('episodes', { episodes });
          }}
        />
        <Whole
          label="Seed"
          value={draft().seed}
          fault={faults().seed}
          onInput={(seed) => {
            change('seed', { seed });
          }}
        />
      </div>
      <p class="hint" data-testid="evaluation-scope">
        {scope()}
      </p>
      <div class="submit">
        <button type="submit" class="primary" disabled={!lab.canOperate() || busy()}>
          Run
        </button>
        <Show when={!lab.canOperate()}>
          <span class="hint">Only the operator can start and cancel evaluations.</span>
        </Show>
      </div>
      <Fault id="evaluation-refused" text={faults().form} />
    </form>
  );
}

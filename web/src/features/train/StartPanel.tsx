// The form for a new training.

import { For, Show, createMemo, createSignal, createUniqueId, type JSX } from 'solid-js';
import type { PolicySummary, RecipeName } from '../../net/protocol.gen';
import { Refusal } from '../../net/requests';
import type { Session, Trial } from '../../lab/slices';
import { Fault } from './Fault';
import { faultWords } from './faults';
import { SelectField, TextField } from './fields';
import {
  BLANK,
  type Draft,
  type Faults,
  faultsOf,
  NAME_LENGTH,
  queryOf,
  RECIPE_WORDS,
  SETTINGS,
  settingText,
  suggestedName,
  withSetting,
} from './recipes';
import type { TrainState } from './state';
import { startTraining } from './trainings';
import { showWrongField } from './wrongField';

interface StartProps {
  readonly lab: Session & Trial;
  readonly state: TrainState;
  /** The new training is shown. */
  readonly onStarted: () => void;
}

type Options = readonly (readonly [value: string, label: string])[];

/** Options that stay the same must not be replaced while the user chooses. */
const sameOptions = { equals: (a: Options, b: Options) => a.join('\n') === b.join('\n') };

export function StartPanel(props: StartProps): JSX.Element {
  const { lab, state } = props;
  const why = createUniqueId();
  let form!: HTMLFormElement;
  let folded!: HTMLDetailsElement;
  const [faults, setFaults] = createSignal<Faults>({});
  const [isBusy, setBusy] = createSignal(false);
  const draft = state.draft;
  const maps = (): readonly string[] => lab.catalog.maps() ?? [];
  const policies = (): readonly PolicySummary[] => lab.catalog.policies() ?? [];
  const map = createMemo(() => {
    const wanted = draft().map;
    return wanted !== undefined && maps().includes(wanted) ? wanted : (lab.scene()?.map ?? '');
  });
  const name = createMemo(() => {
    const taken = [
      ...policies().map((policy) => policy.name),
      ...(lab.catalog.trainings() ?? []).map(({ query }) => query.name),
    ];
    return draft().name ?? suggestedName(map(), taken);
  });
  const mapOptions = createMemo<Options>(() => maps().map((one) => [one, one]), [], sameOptions);
  const starts = createMemo<Options>(
    () => [
      ['', 'random weights'],
      ...policies()
        .filter(({ has_memory }) => !has_memory)
        .map((policy) => [policy.reference, policy.name] as const),
    ],
    [],
    sameOptions,
  );
  // A changed field loses its fault.
  const change = (field: string, next: Draft): void => {
    state.setDraft(next);
    setFaults({ ...faults(), [field]: undefined, form: undefined });
  };
  const refuse = (wrong: Faults): void => {
    setFaults(wrong);
    showWrongField(form);
  };
  const changed = (): number => Object.keys(draft().settings).length;
  const start = async (): Promise<void> => {
    const made = queryOf(draft(), map(), name());
    if ('faults' in made) {
      refuse(made.faults);
      return;
    }
    setFaults({});
    setBusy(true);
    try {
      const id = await startTraining(made.query);
      // The next one gets a name of its own.
      const { map, startFrom, recipe, settings, seed } = draft();
      const same = { startFrom, recipe, settings, seed };
      state.setDraft(map === undefined ? same : { ...same, map });
      state.compare(undefined);
      state.choose(id);
      folded.open = false;
      props.onStarted();
    } catch (reason) {
      refuse(reason instanceof Refusal ? faultsOf(reason) : { form: String(reason) });
    }
    setBusy(false);
  };
  return (
    <form
      ref={form}
      class="train-form"
      novalidate
      onKeyDown={(event) => {
        // A training takes minutes: only the button starts one.
        if (event.key === 'Enter' && event.target instanceof HTMLInputElement)
          event.preventDefault();
      }}
      onSubmit={(event) => {
        event.preventDefault();
        if (lab.canOperate() && !isBusy()) void start();
      }}
    >
      <SelectField
        label="Map"
        value={map()}
        options={mapOptions()}
        fault={faults().map}
        onInput={(value) => {
          change('map', { ...draft(), map: value });
        }}
      />
      <TextField
        label="Policy name"
        value={name()}
        maxLength={NAME_LENGTH}
        fault={faults().name}
        onInput={(value) => {
          change('name', { ...draft(), name: value });
        }}
      />
      <SelectField
        label="Start from"
        value={draft().startFrom}
        options={starts()}
        help="A policy that is trained already learns another map faster."
        fault={faults().start_from}
        onInput={(startFrom) => {
          change('start_from', { ...draft(), startFrom });
        }}
      />
      <SelectField
        label="Recipe"
        value={draft().recipe}
        options={RECIPE_WORDS.map(([id, label]) => [id, label])}
        help={RECIPE_WORDS.find(([id]) => id === draft().recipe)?.[2]}
        fault={faults().recipe}
        onInput={(recipe) => {
          change('recipe', { ...draft(), recipe: recipe as RecipeName, settings: {} });
        }}
      />
      <details ref={folded} class="train-settings">
        <summary>
          Settings
          <Show when={changed() > 0}>
            <span class="count"> {changed()} changed</span>
          </Show>
        </summary>
        <For each={SETTINGS}>
          {(setting) => {
            const field = `settings.${setting.name}`;
            const shared = {
              label: setting.label,
              help: setting.help,
              get value() {
                return settingText(draft(), setting.name);
              },
              get fault() {
                return faults()[field];
              },
              onInput: (text: string) => {
                change(field, withSetting(draft(), setting.name, text));
              },
            };
            return setting.kind === 'choice' ? (
              <SelectField {...shared} options={setting.options} />
            ) : (
              <TextField {...shared} number={setting} />
            );
          }}
        </For>
        <TextField
          label="Seed"
          value={draft().seed}
          number={{ min: 0, step: 1, isWhole: true }}
          help="The same seed and the same settings give the same training."
          fault={faults().seed}
          onInput={(seed) => {
            change('seed', { ...draft(), seed });
          }}
        />
        <button
          type="button"
          class="small"
          onClick={() => {
            state.setDraft({ ...draft(), settings: {}, seed: BLANK.seed });
            setFaults({});
          }}
        >
          Reset the settings
        </button>
      </details>
      <div class="train-submit">
        <button
          type="submit"
          class="primary"
          aria-label={`Train ${name()}`}
          disabled={!lab.canOperate() || isBusy()}
          aria-describedby={lab.canOperate() ? undefined : why}
        >
          Train
        </button>
        <Show when={!lab.canOperate()}>
          <span id={why} class="hint">
            Only the operator can start and change trainings.
          </span>
        </Show>
        {/* Announced at the field itself. */}
        <Show when={faultWords(faults())}>{(words) => <p class="refusal">{words()}</p>}</Show>
      </div>
      <Fault id="training-refused" text={faults().form} />
    </form>
  );
}

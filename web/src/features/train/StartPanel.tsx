// The form for a new training.

import { For, Show, createMemo, type JSX } from 'solid-js';
import type { Session, Trial } from '../../lab/slices';
import { RECIPES } from '../../net/forms.gen';
import type { PolicySummary } from '../../net/protocol.gen';
import { Form } from '../../ui/fields/Form';
import {
  ChoiceField,
  FlagField,
  NumberField,
  type Option,
  TextField,
} from '../../ui/fields/fields';
import {
  BLANK,
  NAME_LENGTH,
  nameFault,
  queryOf,
  SETTINGS,
  settingText,
  suggestedName,
  withSetting,
} from './recipes';
import type { TrainState } from './state';
import { startTraining } from './trainings';

interface StartProps {
  readonly lab: Session & Trial;
  readonly state: TrainState;
  /** The new training is shown. */
  readonly onStarted: () => void;
}

type Options = readonly Option[];

/** Options that stay the same must not be replaced while the user chooses. */
const sameOptions = { equals: (a: Options, b: Options) => a.join('\n') === b.join('\n') };

export function StartPanel(props: StartProps): JSX.Element {
  const { lab, state } = props;
  let folded!: HTMLDetailsElement;
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
  const changed = (): number => Object.keys(draft().settings).length;
  const start = async (): Promise<void> => {
    const id = await startTraining(queryOf(draft(), map(), name()));
    // The next one gets a name of its own.
    const { map: chosen, startFrom, recipe, settings, seed } = draft();
    const same = { startFrom, recipe, settings, seed };
    state.setDraft(chosen === undefined ? same : { ...same, map: chosen });
    state.compare(undefined);
    state.choose(id);
    folded.open = false;
    props.onStarted();
  };
  return (
    // A training takes minutes: only the button starts one.
    <Form
      class="train-form"
      byButtonOnly
      send={start}
      button="Train"
      buttonName={`Train ${name()}`}
      disabled={!lab.canOperate()}
      why="Only the operator can start and change trainings."
    >
      <ChoiceField
        name="map"
        label="Map"
        value={map()}
        options={mapOptions()}
        onChoose={(value) => {
          state.setDraft({ ...draft(), map: value });
        }}
      />
      <TextField
        name="name"
        label="Policy name"
        value={name()}
        maxLength={NAME_LENGTH}
        check={() => nameFault(name())}
        onInput={(value) => {
          state.setDraft({ ...draft(), name: value });
        }}
      />
      <ChoiceField
        name="start_from"
        label="Start from"
        help="A policy that is trained already learns another map faster."
        value={draft().startFrom}
        options={starts()}
        onChoose={(startFrom) => {
          state.setDraft({ ...draft(), startFrom });
        }}
      />
      <ChoiceField
        name="recipe"
        label="Recipe"
        help={RECIPES.map(({ label, help }) => `${label}: ${help}`).join('\n')}
        value={draft().recipe}
        options={RECIPES.map(({ name: recipe, label }) => [recipe, label] as const)}
        onChoose={(recipe) => {
          state.setDraft({ ...draft(), recipe, settings: {} });
        }}
      />
      <details ref={folded} class="train-settings">
        <summary>
          Settings
          <Show when={changed() > 0}>
            <span class="count"> {changed()} changed</span>
          </Show>
        </summary>
        <div class="train-columns">
          <For each={SETTINGS}>
            {(setting) => {
              const text = (): string => settingText(draft(), setting.name);
              const change = (value: string): void => {
                state.setDraft(withSetting(draft(), setting.name, value));
              };
              switch (setting.kind) {
                case 'number':
                  return <NumberField {...setting} value={text()} onInput={change} />;
                case 'choice':
                  return <ChoiceField<string> {...setting} value={text()} onChoose={change} />;
                case 'flag':
                  return (
                    <FlagField
                      {...setting}
                      value={text() === 'true'}
                      onChoose={(value) => {
                        change(String(value));
                      }}
                    />
                  );
              }
            }}
          </For>
          <NumberField
            name="seed"
            label="Seed"
            help="The same seed and the same settings give the same training."
            min={0}
            isWhole
            value={draft().seed}
            onInput={(seed) => {
              state.setDraft({ ...draft(), seed });
            }}
          />
        </div>
        <button
          type="button"
          class="small"
          onClick={() => {
            state.setDraft({ ...draft(), settings: {}, seed: BLANK.seed });
          }}
        >
          Reset the settings
        </button>
      </details>
    </Form>
  );
}

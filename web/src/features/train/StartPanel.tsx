// The form for a new training.

import { For, Show, createMemo, type JSX } from 'solid-js';
import { paceOf } from '../../lab/jobs';
import type { Session, Trial } from '../../lab/slices';
import { RECIPES } from '../../net/forms.gen';
import { Form } from '../../ui/fields/Form';
import {
  ChoiceField,
  FlagField,
  NumberField,
  type Option,
  TextField,
} from '../../ui/fields/fields';
import { numberOf } from '../../ui/fields/number';
import { roughly } from '../../ui/format';
import { SmallButton } from '../../ui/SmallButton';
import {
  BLANK,
  changedSettings,
  NAME_LENGTH,
  nameFault,
  queryOf,
  SETTINGS,
  settingText,
  suggestedName,
  takenNames,
} from './recipes';
import { change, choose, compare, draft, edits } from './state';
import { startTraining } from './trainings';

/** The chosen map, otherwise that of the session. */
export const mapOf = (lab: Session & Trial): string =>
  lab.catalog.maps()?.find((one) => one === draft().map) ?? lab.scene()?.map ?? '';

export function StartPanel(props: {
  lab: Session & Trial;
  /** Whether its button is the primary one. */
  isPrimary: boolean;
  /** The new training is shown. */
  onStarted: () => void;
}): JSX.Element {
  const { lab } = props;
  let folded!: HTMLDetailsElement;
  const maps = (): readonly string[] => lab.catalog.maps() ?? [];
  const map = createMemo(() => mapOf(lab));
  const name = createMemo(() => draft().name ?? suggestedName(map(), takenNames(lab.catalog)));
  const starts = (): readonly Option[] => [
    ['', 'random weights'],
    ...(lab.catalog.policies() ?? [])
      .filter(({ has_memory }) => !has_memory)
      .map((policy) => [policy.reference, policy.name] as const),
  ];
  const estimate = (): string => {
    const each_s = paceOf(lab.catalog, `training_${draft().recipe}`);
    const time_s = each_s * numberOf(settingText(draft(), 'updates'));
    return time_s > 0 ? `about ${roughly(time_s)}` : '';
  };
  const changed = (): number => Object.keys(draft().settings).length;
  const start = async (): Promise<void> => {
    const id = await startTraining(lab.session, queryOf(draft(), map(), name()));
    // The next one gets a name of its own.
    change({ name: undefined });
    compare(undefined);
    choose(id);
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
      buttonClass={props.isPrimary ? 'primary' : ''}
      buttonName={`Train ${name()}`}
      disabled={!lab.canOperate()}
      why="Only the operator can start and change trainings."
      beside={
        <span class="hint" data-testid="training-size">
          {estimate()}
        </span>
      }
    >
      <ChoiceField
        {...edits('map')}
        label="Map"
        value={map()}
        options={maps().map((one) => [one, one])}
      />
      <TextField
        {...edits('name')}
        label="Policy name"
        value={name()}
        maxLength={NAME_LENGTH}
        check={() => nameFault(name())}
      />
      <ChoiceField
        {...edits('start_from')}
        label="Start from"
        help="A policy that is trained already learns another map faster."
        options={starts()}
      />
      <ChoiceField
        {...edits('recipe')}
        label="Recipe"
        help={RECIPES.map(({ label, help }) => `${label}: ${help}`).join('\n')}
        options={RECIPES.map(({ name: recipe, label }) => [recipe, label] as const)}
        onChoose={(recipe) => change({ recipe, settings: {} })}
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
              const put = (value: string): void =>
                change({ settings: changedSettings(draft(), setting.name, value) });
              switch (setting.kind) {
                case 'number':
                  return <NumberField {...setting} value={text()} onInput={put} />;
                case 'choice':
                  return <ChoiceField<string> {...setting} value={text()} onChoose={put} />;
                case 'flag':
                  return (
                    <FlagField
                      {...setting}
                      value={text() === 'true'}
                      onChoose={(value) => put(String(value))}
                    />
                  );
              }
            }}
          </For>
          <NumberField
            {...edits('seed')}
            label="Seed"
            help="The same seed and the same settings give the same training."
            min={0}
            isWhole
          />
        </div>
        <SmallButton onClick={() => change({ settings: {}, seed: BLANK.seed })}>
          Reset the settings
        </SmallButton>
      </details>
    </Form>
  );
}

// The form's part for parameters that take several values.

import { For, Show, type JSX } from 'solid-js';
import { GROUPS } from '../../lab/parameters';
import { ChoiceField, NumberField } from '../../ui/fields/fields';
import { Group } from '../../ui/fields/Row';
import type { VariedDraft } from './request';
import { numberField, NUMBERS } from './varied';

const MOST = 2;
const COUNT = '5';
const INPUTS = [
  ['from', 'From'],
  ['to', 'To'],
  ['count', 'Values'],
] as const;

function ends(name: string): { readonly unit: string; readonly step: number } {
  const { unit, step } = numberField(name);
  return { unit, step };
}

function Row(props: {
  number: number;
  value: VariedDraft | undefined;
  taken: string | undefined;
  onChange: (value: VariedDraft | undefined) => void;
}): JSX.Element {
  const choose = (name: string): void => {
    const field = NUMBERS.find((one) => one.name === name);
    props.onChange(
      field && { name: field.name, from: String(field.min), to: String(field.max), count: COUNT },
    );
  };
  return (
    <div class="vary-row">
      <ChoiceField<string>
        label={props.number === 1 ? 'Vary a parameter' : 'Vary a second parameter'}
        hideLabel
        value={props.value?.name ?? ''}
        options={[['', props.number === 1 ? 'No parameter' : 'No second parameter']]}
        groups={GROUPS.map(({ title, fields }) => ({
          title,
          options: fields
            .filter(({ kind, name }) => kind === 'number' && name !== props.taken)
            .map(({ name, label }) => [name, label]),
        }))}
        onChoose={choose}
      />
      <Show when={props.value}>
        {(value) => (
          <div class="vary-range">
            <For each={INPUTS}>
              {([part, label]) => (
                <NumberField
                  {...(part === 'count' ? { min: 1, isWhole: true } : ends(value().name))}
                  label={label}
                  value={value()[part]}
                  onInput={(text) => props.onChange({ ...value(), [part]: text })}
                />
              )}
            </For>
          </div>
        )}
      </Show>
    </div>
  );
}

export function VaryFields(props: {
  value: readonly VariedDraft[];
  onInput: (value: readonly VariedDraft[]) => void;
}): JSX.Element {
  const put = (index: number, value: VariedDraft | undefined): void => {
    const all = [...props.value.slice(0, index), value, ...props.value.slice(index + 1)];
    props.onInput(all.filter((one) => one !== undefined));
  };
  const rows = (): number[] =>
    Array.from({ length: Math.min(MOST, props.value.length + 1) }, (_, index) => index);
  return (
    <Group
      name="vary"
      label="Vary"
      help="Each value gets its own episodes; the results are drawn over the values."
      value={props.value}
    >
      {() => (
        <For each={rows()}>
          {(index) => (
            <Row
              number={index + 1}
              value={props.value[index]}
              taken={props.value[1 - index]?.name}
              onChange={(value) => put(index, value)}
            />
          )}
        </For>
      )}
    </Group>
  );
}

// The form's part for parameters that take several values.

import { For, Show, createUniqueId, type JSX } from 'solid-js';
import { GROUPS } from '../../lab/parameters';
import { NumberInput } from '../../ui/NumberInput';
import type { VariedDraft } from './request';
import { isNumberName, numberField } from './varied';

const MOST = 2;
const COUNT = '5';
const PARTS = [
  ['from', 'From'],
  ['to', 'To'],
  ['count', 'Values'],
] as const;

function Row(props: {
  number: number;
  value: VariedDraft | undefined;
  taken: string | undefined;
  onChange: (value: VariedDraft | undefined) => void;
}): JSX.Element {
  const id = createUniqueId();
  const unit = (): string => (props.value ? numberField(props.value.name).unit : '');
  const choose = (name: string): void => {
    if (!isNumberName(name)) {
      props.onChange(undefined);
      return;
    }
    const { min, max } = numberField(name);
    props.onChange({ name, from: String(min), to: String(max), count: COUNT });
  };
  return (
    <div class="vary-row">
      <select
        aria-label={props.number === 1 ? 'Vary a parameter' : 'Vary a second parameter'}
        onChange={({ currentTarget }) => {
          choose(currentTarget.value);
        }}
      >
        <option value="" selected={props.value === undefined}>
          {props.number === 1 ? 'No parameter' : 'No second parameter'}
        </option>
        <For each={GROUPS}>
          {(group) => (
            <optgroup label={group.title}>
              <For each={group.fields}>
                {(field) => (
                  <Show when={field.kind === 'number' && field.name !== props.taken}>
                    <option value={field.name} selected={field.name === props.value?.name}>
                      {field.label}
                    </option>
                  </Show>
                )}
              </For>
            </optgroup>
          )}
        </For>
      </select>
      <Show when={props.value}>
        {(value) => (
          <div class="vary-range">
            <For each={PARTS}>
              {([part, label]) => (
                <div class="field">
                  <label for={`${id}-${part}`}>
                    {label}
                    <Show when={part !== 'count' && unit() !== ''}>
                      <span class="unit"> {unit()}</span>
                    </Show>
                  </label>
                  <NumberInput
                    id={`${id}-${part}`}
                    step={part === 'count' ? 1 : numberField(value().name).step}
                    value={value()[part]}
                    onInput={(text) => {
                      props.onChange({ ...value(), [part]: text });
                    }}
                  />
                </div>
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
  fault: string | undefined;
  onInput: (value: VariedDraft[]) => void;
}): JSX.Element {
  const fault = createUniqueId();
  const put = (index: number, value: VariedDraft | undefined): void => {
    const all = [...props.value.slice(0, index), value, ...props.value.slice(index + 1)];
    props.onInput(all.filter((one) => one !== undefined));
  };
  const rows = (): number[] =>
    Array.from({ length: Math.min(MOST, props.value.length + 1) }, (_, index) => index);
  return (
    <fieldset class="boxes" aria-describedby={fault}>
      <legend title="Each value gets its own episodes; the results are drawn over the values">
        Vary
      </legend>
      <For each={rows()}>
        {(index) => (
          <Row
            number={index + 1}
            value={props.value[index]}
            taken={props.value[1 - index]?.name}
            onChange={(value) => {
              put(index, value);
            }}
          />
        )}
      </For>
      <div id={fault} role="alert">
        <Show when={props.fault}>{(text) => <p class="refusal">{text()}</p>}</Show>
      </div>
    </fieldset>
  );
}

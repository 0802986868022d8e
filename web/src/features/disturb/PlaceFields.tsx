// A place of a disturbance: its coordinates, which can be picked in the plan view.

import { Crosshair } from 'lucide';
import { For, onCleanup, type JSX } from 'solid-js';
import type { Vec2 } from '../../lab/geometry';
import type { Picker } from '../../plan/interaction';
import { NumberField } from '../../ui/fields/fields';
import { Icon } from '../../ui/Icon';
import { SmallButton } from '../../ui/SmallButton';

/** As typed. */
export interface Place {
  readonly x_m: string;
  readonly y_m: string;
}

const AXES = ['x', 'y'] as const;
const rounded = (value: number): string => String(Number(value.toFixed(3)));
export const placeAt = (x_m: number, y_m: number): Place => ({
  x_m: rounded(x_m),
  y_m: rounded(y_m),
});

/** Names are `x of NAME in metres` and so on. */
export function PlaceFields(props: {
  name: string;
  value: Place;
  disabled: boolean;
  picker: Picker;
  onValue: (value: Place) => void;
}): JSX.Element {
  let button!: HTMLButtonElement;
  const take = ([x_m, y_m]: Vec2): void => {
    props.onValue(placeAt(x_m, y_m));
    button.focus();
  };
  const isPicking = (): boolean => props.picker.isFor(take);
  onCleanup(() => {
    if (isPicking()) props.picker.cancel();
  });
  return (
    <div class="place wide">
      <For each={AXES}>
        {(axis) => (
          <NumberField
            label={axis}
            fullName={`${axis} of ${props.name} in metres`}
            unit="m"
            min={-10}
            max={10}
            value={props.value[`${axis}_m`]}
            disabled={props.disabled}
            onInput={(text) => props.onValue({ ...props.value, [`${axis}_m`]: text })}
          />
        )}
      </For>
      <SmallButton
        ref={button}
        aria-pressed={isPicking()}
        aria-label={`Pick ${props.name} on the map`}
        title="Click here, then click the place on the map"
        disabled={props.disabled}
        onClick={() => {
          if (isPicking()) {
            props.picker.cancel();
            return;
          }
          props.picker.start(take);
          document.querySelector<HTMLElement>('.stage-canvas')?.focus();
        }}
      >
        <Icon of={Crosshair} />
        Pick
      </SmallButton>
    </div>
  );
}

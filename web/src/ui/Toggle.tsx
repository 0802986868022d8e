// A button that is on or off.

import { Show, type JSX } from 'solid-js';
import { Check } from 'lucide';
import { Icon } from './Icon';

export function Toggle(props: {
  isOn: boolean;
  title?: string;
  onChange: (isOn: boolean) => void;
  children: JSX.Element;
}): JSX.Element {
  return (
    <button
      type="button"
      aria-pressed={props.isOn}
      title={props.title}
      onClick={() => props.onChange(!props.isOn)}
    >
      <Show when={props.isOn}>
        <Icon of={Check} />
      </Show>
      {props.children}
    </button>
  );
}

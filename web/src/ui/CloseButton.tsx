import type { JSX } from 'solid-js';
import { X } from 'lucide';
import { Icon } from './Icon';

export function CloseButton(props: { label: string; onClose: () => void }): JSX.Element {
  return (
    <button type="button" class="bare" aria-label={props.label} onClick={() => props.onClose()}>
      <Icon of={X} />
    </button>
  );
}

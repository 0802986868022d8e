import type { JSX } from 'solid-js';

export function CloseButton(props: { label: string; onClose: () => void }): JSX.Element {
  return (
    <button
      type="button"
      class="bare"
      aria-label={props.label}
      onClick={() => {
        props.onClose();
      }}
    >
      ×
    </button>
  );
}

// A name that is edited in its place.

import { onMount, type JSX } from 'solid-js';
import './TitleForm.css';

export function TitleForm(props: {
  label: string;
  value: string;
  placeholder?: string;
  onSave: (title: string) => void;
  onCancel: () => void;
}): JSX.Element {
  let field!: HTMLInputElement;
  onMount(() => {
    // Set once: the list is polled, and must not replace what the user types.
    field.value = props.value;
    field.focus();
    field.select();
  });
  return (
    <form
      class="title-form"
      onSubmit={(event) => {
        event.preventDefault();
        props.onSave(field.value);
      }}
      onKeyDown={(event) => {
        // While text is composed, Escape ends the composition.
        if (event.key === 'Escape' && !event.isComposing) props.onCancel();
      }}
    >
      <input
        ref={field}
        type="text"
        aria-label={props.label}
        placeholder={props.placeholder}
        autocomplete="off"
        enterkeyhint="done"
      />
      <button type="submit" class="small">
        Save
      </button>
      <button
        type="button"
        class="small"
        onClick={() => {
          props.onCancel();
        }}
      >
        Cancel
      </button>
    </form>
  );
}

// A name that is edited in its place.

import { createSignal, onMount, type JSX } from 'solid-js';
import { SmallButton } from './SmallButton';
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
      <SmallButton type="submit">Save</SmallButton>
      <SmallButton onClick={props.onCancel}>Cancel</SmallButton>
    </form>
  );
}

/** A title that a button opens for editing. `save` returns true if it was saved. */
export function createRenaming(save: (title: string) => Promise<boolean>) {
  let opener: HTMLButtonElement | undefined;
  const [isOn, setOn] = createSignal(false);
  const end = (): void => {
    setOn(false);
    opener?.focus();
  };
  const onSave = async (title: string): Promise<void> => {
    if (await save(title)) end();
  };
  return {
    isOn,
    form: { onSave: (title: string) => void onSave(title), onCancel: end },
    button: {
      ref: (button: HTMLButtonElement) => {
        opener = button;
      },
      onClick: () => setOn(true),
    },
  };
}

// A button that opens a file of the user's computer.

import type { JSX } from 'solid-js';

export function FileButton(props: {
  /** Kinds of files, as for an `<input>`. */
  accept: string;
  /** Name of the hidden input, for tools that set a file. */
  inputName: string;
  disabled: boolean;
  onFile: (file: File) => void;
  class?: string;
  title?: string | undefined;
  children: JSX.Element;
}): JSX.Element {
  let input!: HTMLInputElement;
  return (
    <>
      <button
        type="button"
        class={props.class}
        disabled={props.disabled}
        title={props.title}
        onClick={() => input.click()}
      >
        {props.children}
      </button>
      <input
        ref={input}
        type="file"
        accept={props.accept}
        aria-label={props.inputName}
        hidden
        onChange={() => {
          const file = input.files?.[0];
          if (file) props.onFile(file);
          // The same file may be chosen again after it was corrected.
          input.value = '';
        }}
      />
    </>
  );
}

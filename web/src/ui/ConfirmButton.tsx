// A button that asks before it does something that cannot be undone.

import { Show, createEffect, createSignal, type JSX } from 'solid-js';
import { SmallButton } from './SmallButton';
import './ConfirmButton.css';

interface ConfirmProps {
  /** What the button does, such as `Delete`. */
  readonly verb: string;
  /** What it does it to. */
  readonly of: string;
  /** A sentence before the question. */
  readonly warning?: string | undefined;
  readonly disabled?: boolean;
  readonly title?: string | undefined;
  /** True if it was done. */
  readonly onYes: () => Promise<boolean>;
}

export function ConfirmButton(props: ConfirmProps): JSX.Element {
  let button: HTMLButtonElement | undefined;
  let keepButton: HTMLButtonElement | undefined;
  const [isAsking, setAsking] = createSignal(false);
  const [isBusy, setBusy] = createSignal(false);
  const warning = (): string => (props.warning === undefined ? '' : `${props.warning} `);
  createEffect(() => {
    // The answer that changes nothing.
    if (isAsking()) keepButton?.focus();
  });
  const keep = (): void => {
    setAsking(false);
    button?.focus();
  };
  const act = async (): Promise<void> => {
    if (isBusy()) return;
    setBusy(true);
    const isDone = await props.onYes();
    setBusy(false);
    if (!isDone) keep();
  };
  return (
    <Show
      when={isAsking()}
      fallback={
        <SmallButton
          ref={button}
          aria-label={`${props.verb} ${props.of}`}
          disabled={props.disabled}
          title={props.title}
          onClick={() => setAsking(true)}
        >
          {props.verb}
        </SmallButton>
      }
    >
      <span
        class="confirm"
        role="group"
        aria-label={`${warning()}${props.verb} ${props.of}?`}
        onKeyDown={(event) => {
          if (event.key === 'Escape') keep();
        }}
      >
        <span>
          {warning()}
          {props.verb}?
        </span>
        <SmallButton
          class="small danger"
          aria-label={`Yes, ${props.verb.toLowerCase()} ${props.of}`}
          aria-disabled={isBusy()}
          onClick={() => void act()}
        >
          Yes
        </SmallButton>
        <SmallButton ref={keepButton} aria-label={`Keep ${props.of}`} onClick={keep}>
          Keep
        </SmallButton>
      </span>
    </Show>
  );
}

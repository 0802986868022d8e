// A button that asks before it does something that cannot be undone.

import { Show, createSignal, onMount, type JSX } from 'solid-js';
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

/** The focus is on the answer that changes nothing. */
function Question(
  props: ConfirmProps & { isBusy: boolean; onAnswer: () => void; onKeep: () => void },
): JSX.Element {
  let keep!: HTMLButtonElement;
  const warning = (): string => (props.warning === undefined ? '' : `${props.warning} `);
  onMount(() => {
    keep.focus();
  });
  return (
    <span
      class="confirm"
      role="group"
      aria-label={`${warning()}${props.verb} ${props.of}?`}
      onKeyDown={(event) => {
        if (event.key === 'Escape') props.onKeep();
      }}
    >
      <span>
        {warning()}
        {props.verb}?
      </span>
      <SmallButton
        class="small danger"
        aria-label={`Yes, ${props.verb.toLowerCase()} ${props.of}`}
        aria-disabled={props.isBusy}
        onClick={() => {
          if (!props.isBusy) props.onAnswer();
        }}
      >
        Yes
      </SmallButton>
      <SmallButton ref={keep} aria-label={`Keep ${props.of}`} onClick={props.onKeep}>
        Keep
      </SmallButton>
    </span>
  );
}

export function ConfirmButton(props: ConfirmProps): JSX.Element {
  let button: HTMLButtonElement | undefined;
  const [isAsking, setAsking] = createSignal(false);
  const [isBusy, setBusy] = createSignal(false);
  const keep = (): void => {
    setAsking(false);
    button?.focus();
  };
  const act = async (): Promise<void> => {
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
          onClick={() => {
            setAsking(true);
          }}
        >
          {props.verb}
        </SmallButton>
      }
    >
      <Question {...props} isBusy={isBusy()} onAnswer={() => void act()} onKeep={keep} />
    </Show>
  );
}

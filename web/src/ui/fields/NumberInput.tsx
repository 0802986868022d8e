// The field for a number. Browsers read `0,5` in a field of type `number` as 5, or as an empty one.

import { Show, createEffect, createSignal, createUniqueId, untrack, type JSX } from 'solid-js';
import { numberFault, numberOf, stepped, type Steps } from './number';
import type { InputProps } from './Row';

/** A text that is not a number stays, and the field says why. */
export function NumberInput(
  props: Steps &
    Partial<InputProps> & {
      value: number | string;
      title?: string;
      'aria-busy'?: boolean;
      /** Outside of the limits is a fault, too. */
      isStrict?: boolean;
      /** Each edit, as typed. */
      onInput?: ((text: string) => void) | undefined;
      /** The number, when its edit ends. The shown one is `value` again. */
      onNumber?: ((value: number) => void) | undefined;
      /** Says what is wrong; otherwise it is said below the input. */
      onFault?: (fault: string | undefined) => void;
      onBlur?: () => void;
    },
): JSX.Element {
  let input!: HTMLInputElement;
  const [text, setText] = createSignal('');
  const [isSaid, setSaid] = createSignal(false);
  const faultId = createUniqueId();
  const fault = (): string | undefined => numberFault(text(), props.isStrict ? props : {});
  const say = (isWrong: boolean): void => {
    setSaid(isWrong);
    props.onFault?.(isWrong ? fault() : undefined);
  };
  const read = (): void => {
    setText(input.value);
    say(false);
    // A form with a fault is not submitted.
    input.setCustomValidity(fault() ?? '');
  };
  const show = (): void => {
    input.value = String(props.value);
    read();
  };
  createEffect(() => {
    const value = numberOf(String(props.value));
    // Do not overwrite what the user types: it would lose a sign or a decimal point.
    const isTyped = document.activeElement === input && numberOf(input.value) === value;
    if (props.value !== input.value && !Number.isNaN(props.value) && !isTyped) untrack(show);
  });
  const commit = (): void => {
    say(fault() !== undefined);
    if (isSaid() || !props.onNumber) return;
    props.onNumber(numberOf(input.value));
    show();
  };
  const valueNow = (): number | undefined => {
    const value = numberOf(text());
    return Number.isNaN(value) ? undefined : value;
  };
  return (
    <>
      <input
        ref={input}
        id={props.id}
        class="number"
        type="text"
        role="spinbutton"
        inputmode={props.isWhole ? 'numeric' : (props.min ?? -1) < 0 ? 'text' : 'decimal'}
        autocomplete="off"
        aria-label={props['aria-label']}
        aria-busy={props['aria-busy']}
        aria-valuenow={valueNow()}
        aria-valuemin={props.min}
        aria-valuemax={props.max}
        aria-invalid={props['aria-invalid'] === true || fault() !== undefined}
        aria-describedby={isSaid() && !props.onFault ? faultId : props['aria-describedby']}
        data-step={props.step}
        title={props.title}
        disabled={props.disabled}
        onInput={() => {
          read();
          props.onInput?.(input.value);
        }}
        onKeyDown={(event) => {
          const isUp = event.key === 'ArrowUp';
          if (!isUp && event.key !== 'ArrowDown') return;
          event.preventDefault();
          input.value = stepped(input.value, props, isUp);
          read();
          props.onInput?.(input.value);
          if (props.onNumber) commit();
        }}
        onChange={commit}
        onBlur={props.onBlur}
      />
      <Show when={!props.onFault}>
        <span id={faultId} class="number-fault" role="alert">
          {isSaid() ? fault() : ''}
        </span>
      </Show>
    </>
  );
}

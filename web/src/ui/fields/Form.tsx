// A form. What is wrong is said at the field that it is about, until that is edited or the form is sent again.

import {
  Show,
  createContext,
  createSignal,
  createUniqueId,
  onCleanup,
  useContext,
  type JSX,
} from 'solid-js';
import type { IconNode } from 'lucide';
import { Icon } from '../Icon';
import './fields.css';

/** A field, as the form knows it. */
export interface Entry {
  /** Names of what it fills in, in the request. */
  readonly names: readonly string[];
  readonly label: string;
  /** What is wrong with its value, before the form is sent. */
  readonly check: () => string | undefined;
}

/** Undefined outside of a form: such a field sends its own edits. */
export interface FormFields {
  readonly add: (entry: Entry) => void;
  readonly refusal: (entry: Entry) => string | undefined;
  /** Its value has changed. */
  readonly mend: (entry: Entry) => void;
}

const Fields = createContext<FormFields>();

/** Joins the form around the field. */
export function joinForm(entry: Entry) {
  const form = useContext(Fields);
  form?.add(entry);
  return { refusal: () => form?.refusal(entry), mend: () => form?.mend(entry) };
}

/** `maps[1]` belongs to `maps`, and `settings.discount` to `discount`. */
function nameIn(reason: unknown): string | undefined {
  return reason instanceof Error && 'field' in reason && typeof reason.field === 'string'
    ? reason.field.replace(/\[.*$/, '').replace(/^.*\./, '')
    : undefined;
}

export function Form(props: {
  class: string;
  /** A rejection is said at the field that its `field` names, or below the form. */
  send: () => unknown;
  button: string;
  icon?: IconNode;
  /** The accessible name of the button, if it says more. */
  buttonName?: string;
  buttonClass?: string;
  buttonTitle?: string | undefined;
  /** What the button says until it is answered. */
  pending?: string;
  disabled: boolean;
  /** Why it is disabled. */
  why?: string | undefined;
  /** The button stays in sight, as the foot of the inspector. */
  isFoot?: boolean;
  /** Beside the button. */
  beside?: JSX.Element;
  /** Enter in a field does not send it. */
  byButtonOnly?: boolean;
  children: JSX.Element;
}): JSX.Element {
  let form!: HTMLFormElement;
  const id = createUniqueId();
  const entries = new Set<Entry>();
  const [refusals, setRefusals] = createSignal<ReadonlyMap<Entry, string>>(new Map());
  const [general, setGeneral] = createSignal<string>();
  const [isPending, setPending] = createSignal(false);
  const fields: FormFields = {
    add: (entry) => {
      entries.add(entry);
      onCleanup(() => {
        entries.delete(entry);
        fields.mend(entry);
      });
    },
    refusal: (entry) => refusals().get(entry),
    mend: (entry) => {
      setGeneral(undefined);
      if (refusals().has(entry))
        setRefusals(new Map([...refusals()].filter(([one]) => one !== entry)));
    },
  };
  const refuse = (wrong: ReadonlyMap<Entry, string>): void => {
    setRefusals(wrong);
    const field = form.querySelector<HTMLElement>('[aria-invalid="true"]');
    const folded = field?.closest('details');
    if (folded) folded.open = true;
    field?.focus({ preventScroll: true });
    field?.scrollIntoView({ block: 'nearest' });
  };
  const send = async (): Promise<void> => {
    const wrong = [...entries].flatMap((entry) => {
      const fault = entry.check();
      return fault === undefined ? [] : [[entry, fault] as const];
    });
    setGeneral(undefined);
    refuse(new Map(wrong));
    if (wrong.length > 0) return;
    setPending(true);
    try {
      await props.send();
    } catch (reason) {
      const text = reason instanceof Error ? reason.message : String(reason);
      const name = nameIn(reason);
      const entry = [...entries].find(({ names }) => name !== undefined && names.includes(name));
      if (entry) refuse(new Map([[entry, text]]));
      else setGeneral(text);
    }
    setPending(false);
  };
  /** Why is said at the field, which may be out of view. */
  const summary = (): string | undefined => {
    const [first, second] = refusals().keys();
    if (second) return `${refusals().size} fields are wrong.`;
    return first && `${first.label} is wrong.`;
  };
  return (
    <form
      ref={form}
      class={`form ${props.class}`}
      novalidate
      onKeyDown={(event) => {
        if (props.byButtonOnly && event.key === 'Enter' && event.target instanceof HTMLInputElement)
          event.preventDefault();
      }}
      onSubmit={(event) => {
        event.preventDefault();
        // Enter in a field submits the form even when the button is disabled.
        if (!props.disabled && !isPending()) void send();
      }}
    >
      <Fields.Provider value={fields}>{props.children}</Fields.Provider>
      <div class="form-end" classList={{ 'inspector-foot': props.isFoot }}>
        <button
          type="submit"
          class={props.buttonClass ?? 'primary'}
          aria-label={props.buttonName}
          title={props.buttonTitle}
          disabled={props.disabled || isPending()}
          aria-describedby={`${id}-why`}
        >
          <Show when={props.icon}>{(icon) => <Icon of={icon()} />}</Show>
          {isPending() ? (props.pending ?? props.button) : props.button}
        </button>
        <span id={`${id}-why`} class="hint" hidden={!props.disabled || props.why === undefined}>
          {props.why}
        </span>
        {props.beside}
        <Show when={summary()}>{(words) => <span class="refusal">{words()}</span>}</Show>
        <p class="refusal" role="alert">
          {general()}
        </p>
      </div>
    </form>
  );
}

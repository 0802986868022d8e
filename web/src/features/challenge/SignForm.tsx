// Puts the attempt on the board.

import { Show, createSignal, createUniqueId, type JSX } from 'solid-js';
import type { Contested } from '../../lab/slices';
import { Refusal } from '../../net/requests';
import { recall, remember } from '../../ui/storage';

const NAME_MOST = 24;

export function SignForm(props: { lab: Contested }): JSX.Element {
  const { contest } = props.lab;
  const id = createUniqueId();
  let box!: HTMLFormElement;
  const [player, setPlayer] = createSignal(recall('player') ?? '');
  const [group, setGroup] = createSignal(recall('class') ?? '');
  const [isSending, setSending] = createSignal(false);
  const [refusal, setRefusal] = createSignal<Refusal | Error>();
  const isWrong = (field: string): boolean => {
    const why = refusal();
    return why instanceof Refusal && why.field === field;
  };
  const send = async (): Promise<void> => {
    setRefusal(undefined);
    if (player().trim() === '') {
      setRefusal(new Refusal('Enter your name.', 'player'));
      box.querySelector('input')?.focus();
      return;
    }
    setSending(true);
    try {
      await contest.sign(player().trim(), group().trim());
      remember('player', player().trim());
      remember('class', group().trim());
    } catch (reason) {
      setRefusal(reason instanceof Error ? reason : new Error(String(reason)));
    } finally {
      setSending(false);
    }
  };
  const field = (
    label: string,
    name: string,
    value: () => string,
    store: (text: string) => void,
  ): JSX.Element => (
    <label>
      {label}
      <input
        type="text"
        maxLength={NAME_MOST}
        autocomplete="off"
        value={value()}
        aria-invalid={isWrong(name)}
        aria-describedby={`${id}-refusal`}
        onInput={(event) => {
          store(event.currentTarget.value);
        }}
      />
    </label>
  );
  return (
    <Show
      when={contest.answer()}
      fallback={
        <form
          ref={box}
          class="challenge-sign"
          onSubmit={(event) => {
            event.preventDefault();
            void send();
          }}
        >
          {field('Your name', 'player', player, setPlayer)}
          {field('Class (if you wish)', 'class', group, setGroup)}
          <button type="submit" class="small primary" disabled={isSending()}>
            {isSending() ? 'Checking…' : 'Put it on the board'}
          </button>
          <p id={`${id}-refusal`} class="refusal" role="alert">
            {refusal()?.message}
          </p>
        </form>
      }
    >
      {(answer) => (
        <p role="status">
          <Show
            when={answer().is_kept}
            fallback="Your best attempt on this board is better, so it stays."
          >
            Place {answer().place} of {answer().entries} on the board.
          </Show>
        </p>
      )}
    </Show>
  );
}

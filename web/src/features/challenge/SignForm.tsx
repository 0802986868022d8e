// Puts the attempt on the board.

import { Show, createSignal, type JSX } from 'solid-js';
import type { Contested } from '../../lab/slices';
import { TextField } from '../../ui/fields/fields';
import { Form } from '../../ui/fields/Form';
import { recall, remember } from '../../ui/storage';

const NAME_MOST = 24;

export function SignForm(props: { lab: Contested }): JSX.Element {
  const { contest } = props.lab;
  const [player, setPlayer] = createSignal(recall('player') ?? '');
  const [group, setGroup] = createSignal(recall('class') ?? '');
  const send = async (): Promise<void> => {
    await contest.sign(player().trim(), group().trim());
    remember('player', player().trim());
    remember('class', group().trim());
  };
  return (
    <Show
      when={contest.answer()}
      fallback={
        <Form
          class="challenge-fields"
          send={send}
          button="Put it on the board"
          pending="Checking…"
          disabled={false}
        >
          <TextField
            name="player"
            label="Your name"
            value={player()}
            maxLength={NAME_MOST}
            check={() => (player().trim() === '' ? 'Enter your name.' : undefined)}
            onInput={setPlayer}
          />
          <TextField
            name="class"
            label="Class (if you wish)"
            value={group()}
            maxLength={NAME_MOST}
            onInput={setGroup}
          />
        </Form>
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

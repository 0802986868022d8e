// The program that decides: whether it is there, and how fast it answers.

import { Show, type JSX } from 'solid-js';
import type { ProgramStanding } from '../../net/protocol.gen';
import { standingWords } from './words';
import './program.css';

export function ProgramFacts(props: { program: ProgramStanding | null }): JSX.Element {
  return (
    <div class="program-facts" classList={{ gone: props.program?.is_connected !== true }}>
      <Show when={props.program} fallback={<p>No program is selected: the arm holds.</p>}>
        {(program) => (
          <p class="number" data-testid="program-standing">
            {standingWords(program())}
          </p>
        )}
      </Show>
    </div>
  );
}

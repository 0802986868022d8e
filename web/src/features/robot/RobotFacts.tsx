// The robot client: who is connected, what it commands, and what was refused.

import { For, Show, type JSX } from 'solid-js';
import type { RobotStanding } from '../../net/protocol.gen';
import { shownName } from '../../ui/name';
import { clientMotionWords, clientsWords } from '../../words/robot';
import './robot.css';

/** Refusals that fit into the panel, newest first. */
const SHOWN = 5;

export function RobotFacts(props: { robot: RobotStanding }): JSX.Element {
  const refused = (): RobotStanding['refused'] => props.robot.refused.slice(-SHOWN).reverse();
  return (
    <div class="robot-facts stack">
      <p
        data-testid="robot-motion"
        classList={{ stopped: props.robot.stop !== null }}
        role={props.robot.stop === null ? undefined : 'alert'}
      >
        {clientMotionWords(props.robot)}
      </p>
      <ul aria-label="Robot clients">
        <For each={clientsWords(props.robot)} fallback={<li>No client is connected.</li>}>
          {(words) => <li class="number">{words}</li>}
        </For>
      </ul>
      <Show when={props.robot.refused.length > 0}>
        <h3>Refused</h3>
        <ul aria-label="Refused commands">
          <For each={refused()}>
            {({ what, why }) => (
              <li>
                <b>{shownName(what)}</b>: {why}
              </li>
            )}
          </For>
        </ul>
      </Show>
      <p class="hint">Choose another controller to take the arm back.</p>
    </div>
  );
}

// Why a button of a lesson is disabled.

import { Show, type JSX } from 'solid-js';
import type { Session, Trial } from '../../lab/slices';

export function NotOperator(props: { lab: Session & Trial; to: string }): JSX.Element {
  return (
    <Show when={!props.lab.canOperate()}>
      <p class="lesson-note">
        {props.lab.connection().kind === 'live'
          ? `You are watching: take control at the top of the page to ${props.to}.`
          : `No connection to the server: you cannot ${props.to} now.`}
      </p>
    </Show>
  );
}

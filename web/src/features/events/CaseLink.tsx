// The trial as a test case, to download.

import { Show, type JSX } from 'solid-js';
import type { Session, Trial } from '../../lab/slices';
import { addressOf } from '../../net/base';
import { sessionPath } from '../../net/session';

/** Nothing without a goal: a case needs a delivery that it can expect. */
export function CaseLink(props: { lab: Session & Trial; children: JSX.Element }): JSX.Element {
  const hasGoal = (): boolean => {
    const state = props.lab.state();
    return state !== undefined && (state.goal_m !== null || state.deliveries > 0);
  };
  return (
    <Show when={hasGoal()}>
      <a
        class="button"
        href={addressOf(sessionPath(props.lab.session, 'case.json'))}
        download=""
        title="The trial with all inputs, as a file. In tests/cases it becomes a test"
      >
        {props.children}
      </a>
    </Show>
  );
}

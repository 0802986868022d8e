// The pill of the top bar: what happens now, or what is wrong with the connection.

import { Show, createEffect, createMemo, createSignal, on, type JSX } from 'solid-js';
import { Check, Power, TriangleAlert } from 'lucide';
import { deliveryTime_s } from '../lab/deliveries';
import type { ByHand, Events, Session, Trial } from '../lab/slices';
import { createStuck } from '../lab/stuck';
import { Limiter } from '../net/limiter';
import { loggedOut } from '../net/access';
import { Glyph } from '../ui/Glyph';
import { Icon } from '../ui/Icon';
import { IS_TOUCH } from '../ui/touch';
import { isPhone } from '../ui/windowSize';
import { type Status, statusOf } from './status';
import './StatusPill.css';

/** At most one change per second, so that it can be read. */
const EVERY_MS = 1000;

function Reload(props: { label: string; title: string }): JSX.Element {
  return (
    <button
      type="button"
      class="small primary"
      title={props.title}
      onClick={() => {
        window.location.reload();
      }}
    >
      {props.label}
    </button>
  );
}

export function StatusPill(props: { lab: Session & Trial & Events & ByHand }): JSX.Element {
  const { lab } = props;
  const isStuck = createStuck(lab);
  const now = createMemo(
    () =>
      statusOf(lab.connection(), lab.ended(), lab.state(), {
        isStuck: isStuck(),
        isTouch: IS_TOUCH,
        // With You a press steers.
        setsGoals: lab.canOperate() && !lab.steering.isActive(),
        delivery_s: deliveryTime_s(lab.state(), lab.marks()),
      }),
    undefined,
    {
      equals: (a, b) => a.text === b.text && a.more === b.more && a.controller === b.controller,
    },
  );
  const [shown, setShown] = createSignal<Status>(now());
  const limiter = new Limiter<Status>(EVERY_MS, setShown);
  createEffect(on(now, (status) => limiter.offer(status), { defer: true }));
  const hasEnded = (): boolean => lab.ended() !== undefined;
  return (
    <div class="status" data-tone={shown().tone}>
      {/* The regions are always in the document: screen readers announce what appears inside them. */}
      <p class="status-words" role="status">
        <Show
          when={shown().controller}
          fallback={
            <Show when={shown().tone !== 'plain'}>
              <Icon of={shown().tone === 'good' ? Check : TriangleAlert} />
            </Show>
          }
        >
          {(controller) => <Glyph of={controller()} />}
        </Show>
        <span>{isPhone() ? (shown().short ?? shown().text) : shown().text}</span>
        <Show when={shown().more}>
          {(more) => <span class="status-more number">{more()}</span>}
        </Show>
      </p>
      <Show when={hasEnded()}>
        <Reload label="Restart" title="Reloads the page, which restarts the session" />
      </Show>
      <span class="logged-out" role="alert" aria-label="Login">
        <Show when={loggedOut()}>
          <span>
            <Icon of={Power} />
            login has ended
          </span>
          <Reload label="Log in again" title="Reloads the page, which asks for the token" />
        </Show>
      </span>
    </div>
  );
}

// Everything that happened, oldest first, the view kept at the newest unless one scrolls up.

import { For, Show, createEffect, type JSX } from 'solid-js';
import { clock } from '../../ui/format';
import type { PanelProps, TabPanel } from '../../lab/panel';
import type { LogLine } from '../../lab/model';
import type { EventMessage } from '../../net/protocol.gen';
import { sessionPath } from '../../net/session';
import { eventTitle } from '../../lab/eventStory';
import type { Events, Session, Trial } from '../../lab/slices';

/** Nearer than this to the end counts as reading along. */
const FOLLOW_PX = 24;

const when = (line: LogLine): string =>
  line.sim_time_s === undefined ? '' : clock(line.sim_time_s);

function EventsPanel(props: PanelProps<Session & Trial & Events>): JSX.Element {
  const { lab } = props;
  let box!: HTMLDivElement;
  let following = true;
  /** Only what the timeline still has can be gone back to. */
  const told = (event: EventMessage | undefined): EventMessage | undefined =>
    event && lab.marks().includes(event) ? event : undefined;
  createEffect(() => {
    lab.log();
    if (following) box.scrollTop = box.scrollHeight;
  });
  /** Something is to be delivered, or was: a case can expect it. */
  const caseAddress = (): string | undefined => {
    const state = lab.state();
    if (!state || (!state.goal_m && state.deliveries === 0)) return undefined;
    return sessionPath(lab.session, 'case.json');
  };
  return (
    <div class="log">
      <div
        ref={box}
        class="log-lines"
        role="log"
        aria-live="off"
        aria-label="Events"
        tabindex="0"
        onScroll={() => {
          following = box.scrollHeight - box.scrollTop - box.clientHeight < FOLLOW_PX;
        }}
      >
        <Show when={lab.log().length === 0}>
          <p class="placeholder">Nothing has happened yet.</p>
        </Show>
        <For each={lab.log()}>
          {(line) => (
            <p class="log-line" data-kind={line.kind}>
              <span class="when number">
                <Show when={told(line.event)} fallback={when(line)}>
                  {(event) => (
                    <button
                      type="button"
                      class="link-like"
                      aria-label={`Why: ${eventTitle(event())}`}
                      title="Why?"
                      onClick={() => {
                        lab.inspect(event());
                      }}
                    >
                      {when(line)}
                    </button>
                  )}
                </Show>
              </span>
              <span class="what">
                {line.text}
                <Show when={line.count > 1}> (×{line.count})</Show>
              </span>
            </p>
          )}
        </For>
      </div>
      <Show when={caseAddress()}>
        {(address) => (
          <a
            class="button small"
            href={address()}
            download=""
            title="The trial with all that was done in it, as a file: put into tests/cases, the tests repeat it"
          >
            Keep as test case
          </a>
        )}
      </Show>
    </div>
  );
}

export const EVENTS_TAB: TabPanel = { id: 'events', title: 'Events', panel: EventsPanel };

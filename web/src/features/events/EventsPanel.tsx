// All events, oldest first. The list stays at the newest event unless the user scrolls up.

import { For, Show, createEffect, type JSX } from 'solid-js';
import { clock } from '../../ui/format';
import type { PanelProps, TabPanel } from '../../lab/panel';
import type { LogLine } from '../../lab/model';
import type { EventMessage } from '../../net/protocol.gen';
import { sessionPath } from '../../net/session';
import { eventTitle } from '../../lab/eventStory';
import type { Events, Session, Trial } from '../../lab/slices';
import './events.css';

/** Closer to the end than this, the list follows new events. */
const FOLLOW_PX = 24;

const when = (line: LogLine): string =>
  line.sim_time_s === undefined ? '' : clock(line.sim_time_s);

function EventsPanel(props: PanelProps<Session & Trial & Events>): JSX.Element {
  const { lab } = props;
  let box!: HTMLDivElement;
  let following = true;
  /** The session can only rewind to ticks that the timeline still has. */
  const onTimeline = (event: EventMessage | undefined): EventMessage | undefined =>
    event && lab.marks().includes(event) ? event : undefined;
  createEffect(() => {
    lab.log();
    if (following) box.scrollTop = box.scrollHeight;
  });
  /** A case needs a delivery that it can expect. */
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
          <p class="placeholder">No events yet.</p>
        </Show>
        <For each={lab.log()}>
          {(line) => (
            <p class="log-line" data-kind={line.kind}>
              <span class="when number">
                <Show when={onTimeline(line.event)} fallback={when(line)}>
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
            title="The trial with all inputs, as a file. In tests/cases it becomes a test"
          >
            Keep as test case
          </a>
        )}
      </Show>
    </div>
  );
}

export const EVENTS_TAB: TabPanel = { id: 'events', title: 'Events', panel: EventsPanel };

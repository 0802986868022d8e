// All events, oldest first. The list stays at the newest event unless the user scrolls up.

import { For, Show, createEffect, createMemo, createSignal, type JSX } from 'solid-js';
import { clock } from '../../ui/format';
import type { PanelProps } from '../../lab/panel';
import type { LogLine } from '../../lab/model';
import type { EventMessage } from '../../net/protocol.gen';
import { SYMBOL_LEGEND, eventTitle } from '../../lab/eventStory';
import { CaseBar } from './CaseBar';
import './events.css';

/** Closer to the end than this, the list follows new events. */
const FOLLOW_PX = 24;

/** The button that a key moves to, from the number of the current one and the number of buttons. */
const MOVES: Partial<Record<string, (at: number, count: number) => number>> = {
  ArrowUp: (at) => at - 1,
  ArrowDown: (at) => at + 1,
  Home: () => 0,
  End: (_, count) => count - 1,
};

const when = (line: LogLine): string =>
  line.sim_time_s === undefined ? '' : clock(line.sim_time_s);

export function EventsPanel(props: PanelProps): JSX.Element {
  const { lab } = props;
  let box!: HTMLDivElement;
  let following = true;
  /** Only a moment on the timeline can be explained; an event of the session itself has no story. */
  const onTimeline = (event: EventMessage | undefined): EventMessage | undefined =>
    event && event.kind !== 'session' && lab.marks().includes(event) ? event : undefined;
  const events = createMemo(() =>
    lab
      .log()
      .map(({ event }) => onTimeline(event))
      .filter((event) => event !== undefined),
  );
  const [current, setCurrent] = createSignal<EventMessage>();
  // Tab reaches one event: the last chosen one, otherwise the newest.
  const reached = createMemo(() => {
    const chosen = current();
    return chosen && events().includes(chosen) ? chosen : events().at(-1);
  });
  const onKey = (event: KeyboardEvent): void => {
    const all = events();
    const now = reached();
    const move = MOVES[event.key];
    if (!move || !now) return;
    event.preventDefault();
    const index = Math.min(all.length - 1, Math.max(0, move(all.indexOf(now), all.length)));
    setCurrent(all[index]);
    box.querySelectorAll('button')[index]?.focus();
  };
  createEffect(() => {
    lab.log();
    if (following) box.scrollTop = box.scrollHeight;
  });
  return (
    <div class="log">
      <div
        ref={box}
        class="log-lines"
        role="log"
        aria-live="off"
        aria-label="Events"
        // Without buttons the keyboard could not scroll it.
        tabindex={events().length === 0 ? 0 : undefined}
        onKeyDown={onKey}
        onScroll={() => {
          following = box.scrollHeight - box.scrollTop - box.clientHeight < FOLLOW_PX;
        }}
      >
        <p class="hint log-legend">
          Timeline: {SYMBOL_LEGEND}; a number: events in one mark. Click a mark or a time: why.
        </p>
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
                      title="Why did this happen?"
                      tabindex={reached() === event() ? 0 : -1}
                      onClick={() => {
                        setCurrent(event());
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
      <CaseBar lab={lab} />
    </div>
  );
}

// The story: all events, the newest first. A press unfolds why one happened.

import {
  Show,
  createEffect,
  createMemo,
  createSignal,
  on,
  type Accessor,
  type JSX,
} from 'solid-js';
import { Dynamic } from 'solid-js/web';
import { TriangleAlert } from 'lucide';
import { clock } from '../../ui/format';
import { ForKeyed } from '../../ui/ForKeyed';
import { Icon } from '../../ui/Icon';
import { eventLook, type EventLook } from '../../lab/eventLook';
import type { PanelProps } from '../../lab/panel';
import type { LogLine } from '../../lab/model';
import type { Lab } from '../../lab/slices';
import type { EventMessage } from '../../net/protocol.gen';
import { eventTitle, isSameEvent } from '../../lab/eventStory';
import { CaseBar } from './CaseBar';
import { WhyCard } from './WhyCard';
import './events.css';

/** The button that a key moves to, from the number of the current one and the number of buttons. */
const MOVES: Partial<Record<string, (at: number, count: number) => number>> = {
  ArrowUp: (at) => at - 1,
  ArrowDown: (at) => at + 1,
  Home: () => 0,
  End: (_, count) => count - 1,
};

const TROUBLE: EventLook = { icon: TriangleAlert, colour: 'danger' };

function Line(props: {
  lab: Lab;
  line: LogLine;
  /** The event that can be explained. */
  event: EventMessage | undefined;
  isOpen: boolean;
  isReached: boolean;
  onPress: () => void;
}): JSX.Element {
  const look = (): EventLook => (props.line.event ? eventLook(props.line.event) : TROUBLE);
  const time = (): string =>
    props.line.sim_time_s === undefined ? '' : clock(props.line.sim_time_s);
  const words = (): string =>
    props.line.count > 1 ? `${props.line.text} (×${props.line.count})` : props.line.text;
  /** Only with a story it is a button. */
  const button = (): JSX.ButtonHTMLAttributes<HTMLButtonElement> =>
    props.event
      ? {
          type: 'button',
          'aria-expanded': props.isOpen,
          tabindex: props.isReached ? 0 : -1,
          onClick: props.onPress,
        }
      : {};
  return (
    <li data-kind={props.line.kind}>
      <Dynamic component={props.event ? 'button' : 'div'} class="story-line" {...button()}>
        <Show when={props.event}>
          {(event) => <span class="visually-hidden">Why: {eventTitle(event())}</span>}
        </Show>
        <time class="number" aria-hidden={props.event !== undefined}>
          {time()}
        </time>
        <span class="pin" style={{ color: `var(--${look().colour})` }}>
          <Icon of={look().icon} />
        </span>
        <span class="what">{words()}</span>
      </Dynamic>
      <Show when={props.isOpen && props.event}>
        {(event) => <WhyCard lab={props.lab} event={event()} />}
      </Show>
    </li>
  );
}

export default function EventsPanel(props: PanelProps): JSX.Element {
  const { lab } = props;
  let list!: HTMLUListElement;
  const lines = createMemo(() => lab.log().toReversed());
  /** Only a moment on the timeline can be explained; an event of the session itself has no story. */
  const onTimeline = (event: EventMessage | undefined): EventMessage | undefined =>
    event && event.kind !== 'session' && lab.marks().includes(event) ? event : undefined;
  const events = createMemo(() =>
    lines()
      .map(({ event }) => onTimeline(event))
      .filter((event) => event !== undefined),
  );
  const [current, setCurrent] = createSignal<EventMessage>();
  // Tab reaches one event: the last chosen one, otherwise the newest.
  const reached = createMemo(() => {
    const chosen = current();
    return chosen && events().includes(chosen) ? chosen : events()[0];
  });
  const isOpen = (event: EventMessage | undefined): boolean => {
    const open = lab.inspected();
    return open !== undefined && event !== undefined && isSameEvent(open, event);
  };
  const alone = (): EventMessage | undefined =>
    events().some(isOpen) ? undefined : lab.inspected();
  // Closing a story returns the focus.
  let from: Element | null = null;
  createEffect(
    on(lab.inspected, (now, before) => {
      if (now && !before) from = document.activeElement;
      if (!now && before && from instanceof HTMLElement) from.focus();
    }),
  );
  const onKey = (event: KeyboardEvent): void => {
    const buttons = [...list.querySelectorAll<HTMLElement>('button.story-line')];
    const at = buttons.findIndex((button) => button === event.target);
    const move = MOVES[event.key];
    if (!move || at < 0) return;
    event.preventDefault();
    const index = Math.min(buttons.length - 1, Math.max(0, move(at, buttons.length)));
    setCurrent(events()[index]);
    buttons[index]?.focus();
  };
  const press = (event: EventMessage | undefined): void => {
    setCurrent(event);
    lab.inspect(isOpen(event) ? undefined : event);
  };
  return (
    <>
      <h2>Story</h2>
      <Show when={alone()}>{(event) => <WhyCard lab={lab} event={event()} isAlone />}</Show>
      <Show when={lines().length === 0}>
        <p class="placeholder">No events yet.</p>
      </Show>
      <div role="log" aria-live="off" aria-label="Events" onKeyDown={onKey}>
        <ul ref={list} class="story">
          <ForKeyed each={lines()} by={({ id }) => String(id)}>
            {(line: Accessor<LogLine>) => (
              <Line
                lab={lab}
                line={line()}
                event={onTimeline(line().event)}
                isOpen={isOpen(line().event)}
                isReached={reached() === line().event}
                onPress={() => press(line().event)}
              />
            )}
          </ForKeyed>
        </ul>
      </div>
      <CaseBar lab={lab} />
    </>
  );
}

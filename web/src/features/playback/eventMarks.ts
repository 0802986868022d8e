// Events on the timeline. Those that would overlap share a button. Pure.

import { eventWords } from '../../words/events';
import type { EventMessage } from '../../net/protocol.gen';
import { type EventLook, eventLook } from '../../lab/eventLook';
import { eventTitle, MARKED_KINDS } from '../../lab/eventStory';

/** A title names at most this many events. */
const MAX_TITLES = 6;

/** Of a mark for events of several colours. */
const MIXED: EventLook = { icon: [], colour: 'ink-2' };

export interface Cluster {
  /** Middle of the button. */
  readonly px: number;
  readonly events: readonly EventMessage[];
  /** The most important event. */
  readonly first: EventMessage;
  readonly look: EventLook;
  readonly name: string;
}

function clusterOf(px: number, events: readonly EventMessage[], first: EventMessage): Cluster {
  const rank = (event: EventMessage): number => MARKED_KINDS.indexOf(event.kind);
  for (const event of events) if (rank(event) < rank(first)) first = event;
  const look = eventLook(first);
  const more = events.length === 1 ? '' : `, one of ${events.length} events`;
  return {
    px,
    events,
    first,
    look: events.every((event) => eventLook(event).colour === look.colour) ? look : MIXED,
    name: `${eventTitle(first)}: ${eventWords(first.what)}${more}`,
  };
}

/** What the tooltip of a mark says: its events, one a line. */
export function markTitle(events: readonly EventMessage[]): string {
  const lines = events.slice(0, MAX_TITLES).map(eventTitle);
  const rest = events.length - lines.length;
  return [...lines, ...(rest > 0 ? [`and ${rest} more`] : []), 'Click: why'].join('\n');
}

/** Events in order of time, in clusters at least `gapPx` apart. */
export function clusters(
  events: readonly EventMessage[],
  px: (time_s: number) => number,
  gapPx: number,
): Cluster[] {
  const found: Cluster[] = [];
  for (const event of events) {
    if (!MARKED_KINDS.includes(event.kind)) continue;
    const at = px(event.sim_time_s);
    const last = found.at(-1);
    if (last && at - last.px < gapPx) {
      found[found.length - 1] = clusterOf(last.px, [...last.events, event], last.first);
    } else found.push(clusterOf(at, [event], event));
  }
  return found;
}

// What the page says when its session was closed and opened again, for example by a restart of the server.

import type { Hello } from '../net/protocol.gen';

/** `before` is the opening of the session that the page has seen last, if any. */
export function restartText(
  { opened, resumed_s }: Pick<Hello, 'opened' | 'resumed_s'>,
  before: string | undefined,
  sim_time_s: number,
): string | undefined {
  if (opened === before) return undefined;
  if (resumed_s !== null) {
    // A page that has just come needs to know only while nothing has happened since.
    if (before === undefined && sim_time_s !== resumed_s) return undefined;
    return `This session was interrupted. It goes on at ${resumed_s.toFixed(1)} s, paused.`;
  }
  return before === undefined ? undefined : 'This session was interrupted. It started over.';
}

// Names of recordings: what a recording shows, in a few words.

import { CONTROLLER_LABELS } from '../../lab/parameters';
import type { RecordingContent, RecordingFile } from '../../net/protocol.gen';
import { shownName } from '../../ui/name';

/** A list with more names ends in a number. */
const MAX_NAMES = 3;
const LIST = new Intl.ListFormat('en-GB');

/** `a`, `a and b`, `a, b and c`, `a, b and 2 more`. */
export const joined = (names: readonly string[]): string =>
  LIST.format(
    names.length > MAX_NAMES
      ? [...names.slice(0, MAX_NAMES - 1), `${names.length - MAX_NAMES + 1} more`]
      : names,
  );

function outcome({ delivered, not_delivered }: RecordingContent): string {
  const counts = [
    ...(delivered > 0 ? [`${delivered} delivered`] : []),
    ...(not_delivered > 0 ? [`${not_delivered} not delivered`] : []),
  ];
  return counts.length > 0 ? counts.join(', ') : 'nothing delivered';
}

/** What a recording shows: `Colon, RL: 2 delivered, 1 not delivered`. */
export function shown(content: RecordingContent, live: boolean): string {
  const maps = joined(content.maps);
  if (maps === '') return live ? 'Not run yet' : 'Not run';
  const where = maps.slice(0, 1).toUpperCase() + maps.slice(1);
  if (content.controllers.length === 0) return `${where}, no goal`;
  const controllers = joined(content.controllers.map((name) => CONTROLLER_LABELS[name]));
  return `${where}, ${controllers}: ${outcome(content)}`;
}

/** The name without the title of a user. */
export function ownName({ content, live, session, id }: RecordingFile): string {
  return content ? shown(content, live) : (session ?? id);
}

/** The name that the list shows. */
export function nameOf(file: RecordingFile): string {
  return file.title === null ? ownName(file) : shownName(file.title);
}

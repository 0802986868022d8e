// A recording in the list.

import { Show, type JSX } from 'solid-js';
import { Radio, UserRound } from 'lucide';
import { MapPicture } from '../../lab/MapPicture';
import type { RecordingFile } from '../../net/protocol.gen';
import { Badge } from '../../ui/Badge';
import { duration } from '../../ui/format';
import { nameOf } from './names';
import { size, startedAt } from './recordings';

export function Row(props: {
  file: RecordingFile;
  /** Shown as a picture. */
  map: string | undefined;
  /** Whether it is of the page's session. */
  isOwn: boolean;
  isChosen: boolean;
  onChoose: () => void;
}): JSX.Element {
  const began = (): string => {
    const { session, started } = props.file;
    const { day, time } = started === null ? { day: '', time: '' } : startedAt(started);
    return [nameOf(props.file) === session ? '' : session, day, time].filter(Boolean).join(', ');
  };
  return (
    <tr
      data-recording={props.file.id}
      aria-current={props.isChosen ? 'true' : undefined}
      onClick={() => props.onChoose()}
    >
      <th scope="row">
        <button type="button" class="recording">
          <MapPicture map={props.map} />
          <span>
            <span class="recording-name">{nameOf(props.file)}</span>
            <Show when={props.isOwn}>
              {' '}
              <Badge of={UserRound}>this session</Badge>
            </Show>
            <Show when={props.file.live}>
              {' '}
              <Badge of={Radio}>recording now</Badge>
            </Show>
            <small>{began()}</small>
          </span>
        </button>
      </th>
      <td data-label="Duration">
        <Show when={props.file.content} fallback="–">
          {(content) => duration(content().duration_s)}
        </Show>
      </td>
      <td data-label="Size">{size(props.file.bytes)}</td>
    </tr>
  );
}

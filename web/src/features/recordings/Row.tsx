// A recording in the list.

import { Show, type JSX } from 'solid-js';
import { Radio } from 'lucide';
import { MapPicture } from '../maps/MapPicture';
import type { RecordingFile } from '../../net/protocol.gen';
import { duration } from '../../ui/format';
import { Icon } from '../../ui/Icon';
import { nameOf } from './names';
import { size, startedAt } from './recordings';

export function Row(props: {
  file: RecordingFile;
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
      onClick={() => {
        props.onChoose();
      }}
    >
      <th scope="row">
        <button type="button" class="recording">
          <MapPicture map={props.file.content?.maps[0]} />
          <span>
            <span class="recording-name">{nameOf(props.file)}</span>
            <Show when={props.isOwn}>
              {' '}
              <span class="badge">this session</span>
            </Show>
            <Show when={props.file.live}>
              {' '}
              <span class="badge">
                <Icon of={Radio} />
                recording now
              </span>
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

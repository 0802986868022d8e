// The newest recording of a session so far, to download.

import { Show, createResource, type JSX } from 'solid-js';
import { addressOf } from '../../net/base';
import type { RecordingFile, RecordingList } from '../../net/protocol.gen';
import { get } from '../../net/requests';
import { type Ending, filePath } from './recordings';

/** Undefined if the session is not recorded. */
async function newestOf(session: string): Promise<RecordingFile | undefined> {
  const { recordings } = await get<RecordingList>('/api/recordings');
  return recordings.find((one) => one.session === session);
}

export function RecordingLinks(props: { session: string }): JSX.Element {
  const [newest] = createResource(
    () => props.session,
    (session) => newestOf(session).catch(() => undefined),
  );
  const link = (file: RecordingFile, ending: Ending, words: string): JSX.Element => (
    <a
      class="button"
      href={addressOf(filePath(file.id, ending))}
      download={`${file.id}.${ending}`}
      title="The newest part of the session's recording, as far as it is written"
    >
      {words}
    </a>
  );
  return (
    <Show when={newest()}>
      {(file) => (
        <>
          {link(file(), 'rrd', 'Recording')}
          <Show when={file().log_bytes !== null}>{link(file(), 'ferry', 'Input log')}</Show>
        </>
      )}
    </Show>
  );
}

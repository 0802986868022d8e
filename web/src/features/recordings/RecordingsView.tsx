// The list of recordings, and the one that is open in Rerun's viewer.

import { Show, createSignal, type JSX } from 'solid-js';
import type { RecordingFile } from '../../net/protocol.gen';
import { nameOf } from './names';
import { createRecordings } from './recordings';
import { Row } from './Row';
import { createAttempt } from '../../ui/attempt';
import { ForKeyed } from '../../ui/ForKeyed';
import { Panel } from '../../ui/Panel';
import { SmallButton } from '../../ui/SmallButton';
import { ViewerFrame } from './ViewerFrame';
import './recordings.css';

export default function RecordingsView(props: {
  /** The session of the page. */
  session: string;
  /** Its tick: it is recorded while it moves. */
  tick: number | undefined;
}): JSX.Element {
  const { list, error, refresh, rename, discard } = createRecordings(() => props.tick);
  const [open, setOpen] = createSignal<RecordingFile>();
  const { attempt, refusal } = createAttempt();
  let rows: HTMLTableSectionElement | undefined;
  let refresher!: HTMLButtonElement;
  const rowOf = (id: string): HTMLTableRowElement | undefined =>
    [...(rows?.rows ?? [])].find((row) => row.dataset.recording === id);
  const close = (): void => {
    const id = open()?.id;
    setOpen(undefined);
    // The Close button is removed with its focus: give the focus back.
    if (id !== undefined) rowOf(id)?.querySelector('button')?.focus();
  };
  const discardAt = async (id: string): Promise<boolean> => {
    const row = rowOf(id);
    const other = row?.nextElementSibling ?? row?.previousElementSibling;
    if (!(await attempt(discard(id)))) return false;
    if (open()?.id === id) setOpen(undefined);
    // The button with the focus was removed.
    if (document.activeElement === document.body)
      (other?.isConnected ? other.querySelector('button') : refresher)?.focus();
    return true;
  };
  const newest = (id: string): RecordingFile | undefined => list()?.find((file) => file.id === id);
  return (
    <main class="view recordings" data-open={open() ? '' : undefined}>
      <Panel
        class="recordings-list"
        name="Recordings"
        head={
          <SmallButton ref={refresher} onClick={refresh}>
            Refresh
          </SmallButton>
        }
      >
        <Show when={refusal() ?? error()}>
          {(text) => (
            <p class="recordings-error" role="alert">
              {text()}
            </p>
          )}
        </Show>
        <div class="recordings-scroll">
          <Show
            when={list()?.length}
            fallback={
              <p class="placeholder">
                {list() ? 'No recordings yet. Every session is recorded.' : 'Loading the list…'}
              </p>
            }
          >
            <table>
              <thead>
                <tr>
                  <th scope="col">Recording</th>
                  <th scope="col" class="duration" title="Simulated time, without pauses">
                    Duration
                  </th>
                  <th scope="col" class="size">
                    Size
                  </th>
                  <th scope="col">
                    <span class="visually-hidden">Open, download, rename and delete</span>
                  </th>
                </tr>
              </thead>
              <tbody ref={rows}>
                <ForKeyed each={list()} by={({ id }) => id}>
                  {(file) => (
                    <Row
                      file={file()}
                      isOwn={file().session === props.session}
                      isOpen={open()?.id === file().id}
                      onOpen={() => setOpen(file())}
                      onRename={(title) => attempt(rename(file().id, title))}
                      onDelete={() => discardAt(file().id)}
                    />
                  )}
                </ForKeyed>
              </tbody>
            </table>
          </Show>
        </div>
      </Panel>
      <Show when={open()} keyed>
        {(file) => (
          <ViewerFrame
            file={file}
            name={nameOf(newest(file.id) ?? file)}
            onAgain={() => setOpen({ ...file, ...newest(file.id) })}
            onClose={close}
          />
        )}
      </Show>
    </main>
  );
}

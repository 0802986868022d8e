// The list of recordings, or the one that is open in Rerun's viewer; the chosen one in the inspector.

import { Show, createMemo, createSignal, type JSX } from 'solid-js';
import { RotateCw } from 'lucide';
import type { RecordingFile } from '../../net/protocol.gen';
import { nameOf } from './names';
import { createRecordings, size } from './recordings';
import { RecordingPanel } from './RecordingPanel';
import { Row } from './Row';
import { createAttempt } from '../../ui/attempt';
import { ForKeyed } from '../../ui/ForKeyed';
import { counted } from '../../ui/format';
import { Icon } from '../../ui/Icon';
import { SmallButton } from '../../ui/SmallButton';
import { ViewerFrame } from './ViewerFrame';
import '../../ui/dataTable.css';
import './recordings.css';

export default function RecordingsView(props: {
  /** The session of the page. */
  session: string;
  /** Its tick: it is recorded while it moves. */
  tick: number | undefined;
  /** The maps of the server; undefined before it has sent them. */
  maps: readonly string[] | undefined;
}): JSX.Element {
  const { list, error, refresh, rename, discard } = createRecordings(() => props.tick);
  const [open, setOpen] = createSignal<RecordingFile>();
  const [choice, setChoice] = createSignal<string>();
  const { attempt, refusal } = createAttempt();
  let rows: HTMLTableSectionElement | undefined;
  let refresher!: HTMLButtonElement;
  let opener: HTMLButtonElement | undefined;
  /** The map of a recording, unless it is of another server or was deleted. */
  const mapOf = ({ content }: RecordingFile): string | undefined =>
    props.maps?.find((map) => map === content?.maps[0]);
  const isOwn = ({ session }: RecordingFile): boolean => session === props.session;
  /** The newest of the page's session, until another one is chosen. */
  const chosen = createMemo(() => {
    const all = list() ?? [];
    return all.find(({ id }) => id === choice()) ?? all.find(isOwn) ?? all[0];
  });
  const rowOf = (id: string): HTMLTableRowElement | undefined =>
    [...(rows?.rows ?? [])].find((row) => row.dataset.recording === id);
  const close = (): void => {
    setOpen(undefined);
    // The Close button is removed with its focus: give the focus back.
    opener?.focus();
  };
  const discardAt = async (id: string): Promise<boolean> => {
    const row = rowOf(id);
    const other = row?.nextElementSibling ?? row?.previousElementSibling;
    if (!(await attempt(discard(id)))) return false;
    if (open()?.id === id) setOpen(undefined);
    setChoice(other instanceof HTMLElement ? other.dataset.recording : undefined);
    // The button with the focus was removed.
    if (document.activeElement === document.body)
      (other?.isConnected ? other.querySelector('button') : refresher)?.focus();
    return true;
  };
  const newest = (id: string): RecordingFile | undefined => list()?.find((file) => file.id === id);
  const total = (files: readonly RecordingFile[]): string =>
    size(files.reduce((sum, { bytes }) => sum + bytes, 0));
  return (
    <>
      <main class="view recordings" data-open={open() ? '' : undefined}>
        <Show when={refusal() ?? error()}>
          {(text) => (
            <p class="recordings-error" role="alert">
              {text()}
            </p>
          )}
        </Show>
        <Show
          when={open()}
          keyed
          fallback={
            <>
              <header class="recordings-head">
                <Show
                  when={list()?.length}
                  fallback={list() ? 'No recordings yet. Every session is recorded.' : 'Loading…'}
                >
                  {counted(list()?.length ?? 0, 'recording')} on this server, {total(list() ?? [])}
                </Show>
                <SmallButton class="small ghost" ref={refresher} onClick={refresh}>
                  <Icon of={RotateCw} />
                  Refresh
                </SmallButton>
              </header>
              <Show when={list()?.length}>
                <table class="data-table" aria-label="Recordings">
                  <thead>
                    <tr>
                      <th scope="col">Recording</th>
                      <th scope="col" title="Simulated time, without pauses">
                        Duration
                      </th>
                      <th scope="col">Size</th>
                    </tr>
                  </thead>
                  <tbody ref={rows}>
                    <ForKeyed each={list()} by={({ id }) => id}>
                      {(file) => (
                        <Row
                          file={file()}
                          map={mapOf(file())}
                          isOwn={isOwn(file())}
                          isChosen={chosen()?.id === file().id}
                          onChoose={() => setChoice(file().id)}
                        />
                      )}
                    </ForKeyed>
                  </tbody>
                </table>
              </Show>
            </>
          }
        >
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
      <Show when={chosen()?.id} keyed>
        {(id) => (
          <Show when={newest(id)}>
            {(file) => (
              <RecordingPanel
                file={file()}
                map={mapOf(file())}
                isOpen={open()?.id === id}
                openerRef={(button) => {
                  opener = button;
                }}
                onOpen={() => {
                  if (open()) close();
                  else setOpen(file());
                }}
                onRename={(title) => attempt(rename(id, title))}
                onDelete={() => discardAt(id)}
              />
            )}
          </Show>
        )}
      </Show>
    </>
  );
}

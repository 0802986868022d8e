// The list of recordings, and the one that is open in Rerun's viewer.

import { For, Show, createSignal, type Accessor, type JSX } from 'solid-js';
import type { RecordingFile } from '../../net/protocol.gen';
import { createRecordings, type Ending, fileAddress, size, startedAt, title } from './recordings';
import type { Theme } from '../../ui/theme';
import { ViewerFrame } from './ViewerFrame';
import './recordings.css';

interface RowProps {
  readonly file: RecordingFile;
  readonly isOpen: boolean;
  readonly onOpen: () => void;
}

function Download(props: { file: RecordingFile; ending: Ending; words: string }): JSX.Element {
  const what = (): string => (props.ending === 'ferry' ? 'the input log of ' : '');
  return (
    <a
      class="button small"
      href={fileAddress(props.file.id, props.ending)}
      download={`${props.file.id}.${props.ending}`}
      title={props.ending === 'ferry' ? 'Input log: “ferry replay” runs it again' : undefined}
      aria-label={`Download ${what()}${title(props.file)}`}
    >
      {props.words}
    </a>
  );
}

function Row(props: RowProps): JSX.Element {
  return (
    <tr data-recording={props.file.id} aria-current={props.isOpen ? 'true' : undefined}>
      <th scope="row">
        {props.file.session ?? props.file.id}
        <Show when={props.file.live}>
          <span class="being-recorded">recording now</span>
        </Show>
      </th>
      <td class="number started">
        <Show when={props.file.started} fallback="–">
          {(started) => (
            <>
              <span>{startedAt(started()).day},</span> <span>{startedAt(started()).time}</span>
            </>
          )}
        </Show>
      </td>
      <td class="number size">{size(props.file.bytes)}</td>
      <td class="deeds">
        <button
          type="button"
          class="small"
          aria-label={`Open ${title(props.file)}`}
          onClick={() => {
            props.onOpen();
          }}
        >
          Open
        </button>
        <Download file={props.file} ending="rrd" words="Download" />
        <Show when={props.file.log_bytes !== null}>
          <Download file={props.file} ending="ferry" words="Log" />
        </Show>
      </td>
    </tr>
  );
}

export function RecordingsView(props: { theme: Accessor<Theme> }): JSX.Element {
  const { list, error, refresh } = createRecordings();
  const [open, setOpen] = createSignal<RecordingFile>();
  let rows: HTMLTableSectionElement | undefined;
  const close = (): void => {
    const id = open()?.id;
    setOpen(undefined);
    // The Close button is removed with its focus: give the focus back.
    const row = [...(rows?.rows ?? [])].find((row) => row.dataset.recording === id);
    row?.querySelector('button')?.focus();
  };
  const newest = (id: string): RecordingFile | undefined => list()?.find((file) => file.id === id);
  return (
    <main class="view recordings" data-open={open() ? '' : undefined}>
      <section class="panel recordings-list" aria-labelledby="recordings-title">
        <div class="panel-head">
          <h2 id="recordings-title">Recordings</h2>
          <button type="button" class="small" onClick={refresh}>
            Refresh
          </button>
        </div>
        <Show when={error()}>
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
                  <th scope="col">Session</th>
                  <th scope="col">Started</th>
                  <th scope="col" class="size">
                    Size
                  </th>
                  <th scope="col">
                    <span class="visually-hidden">Open and download</span>
                  </th>
                </tr>
              </thead>
              <tbody ref={rows}>
                {/* By id: a row stays, with the focus in it, when its file has grown. */}
                <For each={list()?.map((file) => file.id)}>
                  {(id) => (
                    <Show when={newest(id)}>
                      {(file) => (
                        <Row
                          file={file()}
                          isOpen={open()?.id === id}
                          onOpen={() => setOpen(file())}
                        />
                      )}
                    </Show>
                  )}
                </For>
              </tbody>
            </table>
          </Show>
        </div>
      </section>
      <Show when={open()} keyed>
        {(file) => (
          <ViewerFrame
            file={file}
            theme={props.theme}
            onAgain={() => setOpen({ ...file, ...newest(file.id) })}
            onClose={close}
          />
        )}
      </Show>
    </main>
  );
}

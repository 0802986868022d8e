// A recording in the list: its name, its files, its title and its deletion.

import { Show, createSignal, type JSX } from 'solid-js';
import { ConfirmButton } from '../../ui/ConfirmButton';
import { TitleForm } from '../../ui/TitleForm';
import type { RecordingFile } from '../../net/protocol.gen';
import { duration, nameOf, ownName } from './names';
import { type Ending, filePath, label, size, startedAt } from './recordings';
import { addressOf } from '../../net/base';

interface RowProps {
  readonly file: RecordingFile;
  /** Whether it is of the page's session. */
  readonly isOwn: boolean;
  readonly isOpen: boolean;
  readonly onOpen: () => void;
  /** True if it was done. */
  readonly onRename: (title: string) => Promise<boolean>;
  readonly onDelete: () => Promise<boolean>;
}

function Download(props: { file: RecordingFile; ending: Ending; words: string }): JSX.Element {
  const what = (): string => (props.ending === 'ferry' ? 'the input log of ' : '');
  return (
    <a
      class="button small"
      href={addressOf(filePath(props.file.id, props.ending))}
      download={`${props.file.id}.${props.ending}`}
      title={props.ending === 'ferry' ? 'Input log: “ferry replay” runs it again' : undefined}
      aria-label={`Download ${what()}${label(props.file)}`}
    >
      {props.words}
    </a>
  );
}

function Facts(props: { file: RecordingFile; isOwn: boolean }): JSX.Element {
  return (
    <span class="facts">
      <Show when={props.file.session}>
        {(session) => <Show when={nameOf(props.file) !== session()}>{session()}, </Show>}
      </Show>
      <Show when={props.file.started}>
        {(started) => (
          <>
            <span>{startedAt(started()).day},</span> <span>{startedAt(started()).time}</span>
          </>
        )}
      </Show>
      <Show when={props.isOwn}>
        <span class="own-session">this session</span>
      </Show>
      <Show when={props.file.live}>
        <span class="being-recorded">recording now</span>
      </Show>
    </span>
  );
}

export function Row(props: RowProps): JSX.Element {
  let renamer!: HTMLButtonElement;
  const [isRenaming, setRenaming] = createSignal(false);
  const endRenaming = (): void => {
    setRenaming(false);
    renamer.focus();
  };
  const rename = async (title: string): Promise<void> => {
    if (await props.onRename(title)) endRenaming();
  };
  return (
    <tr data-recording={props.file.id} aria-current={props.isOpen ? 'true' : undefined}>
      <th scope="row">
        <Show when={isRenaming()} fallback={<span class="name">{nameOf(props.file)}</span>}>
          <TitleForm
            label={`Title of ${label(props.file)}`}
            value={props.file.title ?? ''}
            placeholder={ownName(props.file)}
            onSave={(title) => void rename(title)}
            onCancel={endRenaming}
          />
        </Show>
        <Facts file={props.file} isOwn={props.isOwn} />
      </th>
      <td class="number duration">
        <Show when={props.file.content} fallback="–">
          {(content) => duration(content().duration_s)}
        </Show>
      </td>
      <td class="number size">{size(props.file.bytes)}</td>
      <td class="deeds">
        <button
          type="button"
          class="small"
          aria-label={`Open ${label(props.file)}`}
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
        <button
          ref={renamer}
          type="button"
          class="small"
          aria-label={`Rename ${label(props.file)}`}
          onClick={() => {
            setRenaming(true);
          }}
        >
          Rename
        </button>
        <Show when={!props.file.live}>
          <ConfirmButton verb="Delete" of={label(props.file)} onYes={props.onDelete} />
        </Show>
      </td>
    </tr>
  );
}

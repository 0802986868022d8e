// A recording in the list: its name, its files, its title and its deletion.

import { Show, type JSX } from 'solid-js';
import { ConfirmButton } from '../../ui/ConfirmButton';
import { SmallButton } from '../../ui/SmallButton';
import { createRenaming, TitleForm } from '../../ui/TitleForm';
import type { RecordingFile } from '../../net/protocol.gen';
import { duration } from '../../ui/format';
import { nameOf, ownName } from './names';
import { type Ending, filePath, label, size, startedAt } from './recordings';
import { addressOf } from '../../net/base';

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

export function Row(props: {
  file: RecordingFile;
  /** Whether it is of the page's session. */
  isOwn: boolean;
  isOpen: boolean;
  onOpen: () => void;
  /** True if it was done. */
  onRename: (title: string) => Promise<boolean>;
  onDelete: () => Promise<boolean>;
}): JSX.Element {
  const renaming = createRenaming((title) => props.onRename(title));
  return (
    <tr data-recording={props.file.id} aria-current={props.isOpen ? 'true' : undefined}>
      <th scope="row">
        <Show when={renaming.isOn()} fallback={<span class="name">{nameOf(props.file)}</span>}>
          <TitleForm
            {...renaming.form}
            label={`Title of ${label(props.file)}`}
            value={props.file.title ?? ''}
            placeholder={ownName(props.file)}
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
        <SmallButton aria-label={`Open ${label(props.file)}`} onClick={props.onOpen}>
          Open
        </SmallButton>
        <Download file={props.file} ending="rrd" words="Download" />
        <Show when={props.file.log_bytes !== null}>
          <Download file={props.file} ending="ferry" words="Log" />
        </Show>
        <SmallButton {...renaming.button} aria-label={`Rename ${label(props.file)}`}>
          Rename
        </SmallButton>
        <Show when={!props.file.live}>
          <ConfirmButton verb="Delete" of={label(props.file)} onYes={props.onDelete} />
        </Show>
      </td>
    </tr>
  );
}

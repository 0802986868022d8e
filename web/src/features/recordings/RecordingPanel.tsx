// The chosen recording: what it holds, its files, its title and its deletion.

import { Show, type JSX } from 'solid-js';
import { Download as DownloadIcon, List, MonitorPlay } from 'lucide';
import { MapPicture } from '../../lab/MapPicture';
import { addressOf } from '../../net/base';
import type { RecordingFile } from '../../net/protocol.gen';
import { ConfirmButton } from '../../ui/ConfirmButton';
import { Fact } from '../../ui/Fact';
import { duration } from '../../ui/format';
import { Icon } from '../../ui/Icon';
import { SmallButton } from '../../ui/SmallButton';
import { createRenaming, TitleForm } from '../../ui/TitleForm';
import { nameOf, ownName } from './names';
import { type Ending, filePath, label, size, startedAt } from './recordings';

function Download(props: { file: RecordingFile; ending: Ending; words: string }): JSX.Element {
  const what = (): string => (props.ending === 'ferry' ? 'input log' : 'Rerun file');
  return (
    <a
      class="button"
      href={addressOf(filePath(props.file.id, props.ending))}
      download={`${props.file.id}.${props.ending}`}
      title={props.ending === 'ferry' ? 'Input log: “ferry replay” runs it again' : undefined}
      aria-label={`Download the ${what()} of ${label(props.file)}`}
    >
      <Icon of={DownloadIcon} />
      {props.words}
    </a>
  );
}

function Facts(props: { file: RecordingFile }): JSX.Element {
  return (
    <dl class="facts">
      <Show when={props.file.content}>
        {(content) => (
          <>
            <Fact
              name="Delivered"
              value={`${content().delivered} of ${content().delivered + content().not_delivered}`}
            />
            <Fact name="Duration" value={duration(content().duration_s)} />
          </>
        )}
      </Show>
      <Fact name="Size" value={size(props.file.bytes)} />
      <Show when={props.file.session}>
        {(session) => <Fact name="Session" value={session()} />}
      </Show>
      <Show when={props.file.started}>
        {(started) => (
          <Fact name="Began" value={`${startedAt(started()).day}, ${startedAt(started()).time}`} />
        )}
      </Show>
    </dl>
  );
}

export function RecordingPanel(props: {
  file: RecordingFile;
  /** Shown as a picture. */
  map: string | undefined;
  isOpen: boolean;
  openerRef: (button: HTMLButtonElement) => void;
  /** Opens it in the viewer, or goes back to the list. */
  onOpen: () => void;
  /** True if it was done. */
  onRename: (title: string) => Promise<boolean>;
  onDelete: () => Promise<boolean>;
}): JSX.Element {
  const renaming = createRenaming((title) => props.onRename(title));
  return (
    <aside class="inspector" aria-label="Chosen recording">
      <div class="inspector-panel recording-panel">
        <Show when={props.map}>{(map) => <MapPicture map={map()} />}</Show>
        <Show when={renaming.isOn()} fallback={<h2>{nameOf(props.file)}</h2>}>
          <TitleForm
            {...renaming.form}
            label={`Title of ${label(props.file)}`}
            value={props.file.title ?? ''}
            placeholder={ownName(props.file)}
          />
        </Show>
        <Facts file={props.file} />
        <div class="recording-deeds">
          <Download file={props.file} ending="rrd" words="Rerun file" />
          <Show when={props.file.log_bytes !== null}>
            <Download file={props.file} ending="ferry" words="Log" />
          </Show>
          <SmallButton
            {...renaming.button}
            class="ghost"
            aria-label={`Rename ${label(props.file)}`}
          >
            Rename
          </SmallButton>
          <Show when={!props.file.live}>
            <ConfirmButton verb="Delete" of={label(props.file)} onYes={props.onDelete} />
          </Show>
        </div>
        <footer class="inspector-foot">
          <button
            type="button"
            ref={props.openerRef}
            classList={{ primary: !props.isOpen }}
            aria-label={props.isOpen ? undefined : `Open in Rerun: ${label(props.file)}`}
            onClick={() => props.onOpen()}
          >
            <Icon of={props.isOpen ? List : MonitorPlay} />
            {props.isOpen ? 'Back to the list' : 'Open in Rerun'}
          </button>
        </footer>
      </div>
    </aside>
  );
}

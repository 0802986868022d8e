// A recording in the list: its name, its files, its title and its deletion.

import { Show, createSignal, onMount, type JSX } from 'solid-js';
import type { RecordingFile } from '../../net/protocol.gen';
import { duration, nameOf, ownName } from './names';
import { type Ending, fileAddress, label, size, startedAt } from './recordings';

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
      href={fileAddress(props.file.id, props.ending)}
      download={`${props.file.id}.${props.ending}`}
      title={props.ending === 'ferry' ? 'Input log: “ferry replay” runs it again' : undefined}
      aria-label={`Download ${what()}${label(props.file)}`}
    >
      {props.words}
    </a>
  );
}

function TitleForm(props: {
  file: RecordingFile;
  onSave: (title: string) => void;
  onCancel: () => void;
}): JSX.Element {
  let field!: HTMLInputElement;
  onMount(() => {
    // Set once: the list is polled, and must not replace what the user types.
    field.value = props.file.title ?? '';
    field.focus();
    field.select();
  });
  return (
    <form
      class="title-form"
      onSubmit={(event) => {
        event.preventDefault();
        props.onSave(field.value);
      }}
      onKeyDown={(event) => {
        // While text is composed, Escape ends the composition.
        if (event.key === 'Escape' && !event.isComposing) props.onCancel();
      }}
    >
      <input
        ref={field}
        type="text"
        aria-label={`Title of ${label(props.file)}`}
        placeholder={ownName(props.file)}
        autocomplete="off"
        enterkeyhint="done"
      />
      <button type="submit" class="small">
        Save
      </button>
      <button
        type="button"
        class="small"
        onClick={() => {
          props.onCancel();
        }}
      >
        Cancel
      </button>
    </form>
  );
}

/** Asks before a recording is deleted. The focus is on the answer that changes nothing. */
function Confirm(props: {
  of: string;
  isBusy: boolean;
  onYes: () => void;
  onKeep: () => void;
}): JSX.Element {
  let keep!: HTMLButtonElement;
  onMount(() => {
    keep.focus();
  });
  return (
    <span
      class="confirm"
      role="group"
      aria-label={`Delete ${props.of}?`}
      onKeyDown={(event) => {
        if (event.key === 'Escape') props.onKeep();
      }}
    >
      <span>Delete?</span>
      <button
        type="button"
        class="small danger"
        aria-label={`Yes, delete ${props.of}`}
        aria-disabled={props.isBusy}
        onClick={() => {
          if (!props.isBusy) props.onYes();
        }}
      >
        Yes
      </button>
      <button
        ref={keep}
        type="button"
        class="small"
        aria-label={`Keep ${props.of}`}
        onClick={() => {
          props.onKeep();
        }}
      >
        Keep
      </button>
    </span>
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
  let deleter: HTMLButtonElement | undefined;
  const [isRenaming, setRenaming] = createSignal(false);
  const [isAsking, setAsking] = createSignal(false);
  const [isBusy, setBusy] = createSignal(false);
  const endRenaming = (): void => {
    setRenaming(false);
    renamer.focus();
  };
  const keep = (): void => {
    setAsking(false);
    deleter?.focus();
  };
  const rename = async (title: string): Promise<void> => {
    if (await props.onRename(title)) endRenaming();
  };
  const discard = async (): Promise<void> => {
    setBusy(true);
    const isDone = await props.onDelete();
    setBusy(false);
    if (!isDone) keep();
  };
  return (
    <tr data-recording={props.file.id} aria-current={props.isOpen ? 'true' : undefined}>
      <th scope="row">
        <Show when={isRenaming()} fallback={<span class="name">{nameOf(props.file)}</span>}>
          <TitleForm
            file={props.file}
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
          <Show
            when={isAsking()}
            fallback={
              <button
                ref={deleter}
                type="button"
                class="small"
                aria-label={`Delete ${label(props.file)}`}
                onClick={() => {
                  setAsking(true);
                }}
              >
                Delete
              </button>
            }
          >
            <Confirm
              of={label(props.file)}
              isBusy={isBusy()}
              onYes={() => void discard()}
              onKeep={keep}
            />
          </Show>
        </Show>
      </td>
    </tr>
  );
}

// What the server says about the drawing, where it comes from, and where it goes.

import { For, Show, createMemo, type JSX } from 'solid-js';
import { Check as CheckIcon, Download, TriangleAlert } from 'lucide';
import { checkOf, checkOfMap, freeName, mapName, refuseLarge } from '../../lab/maps';
import type { Session, Trial } from '../../lab/slices';
import { createAttempt } from '../../ui/attempt';
import { Badge } from '../../ui/Badge';
import { TextField } from '../../ui/fields/fields';
import { FileButton } from '../../ui/FileButton';
import { download } from '../../ui/download';
import { Icon } from '../../ui/Icon';
import { type Check, verdictOf } from './check';
import { BLANK, type Drawing, svgText } from './drawing';
import type { Editor } from './editor';
import { drawingOf } from './import';
import { markFaults } from './marks';

export function SidePanel(props: {
  lab: Session & Trial;
  editor: Editor;
  check: Check;
  /** Adds the drawing to the server's maps and loads it. */
  onSave: (file: File) => Promise<void>;
}): JSX.Element {
  const { lab } = props;
  /** Opens drawings. */
  const { attempt, refusal, isBusy } = createAttempt();
  const plainName = (): string => mapName(props.editor.name()) || 'map';
  /** The whole drawing, with what was begun. */
  const fileOf = (name: string): File => {
    props.editor.act({ type: 'finish' });
    const svg = svgText(props.editor.editing().drawing);
    return new File([svg], `${name}.svg`, { type: 'image/svg+xml' });
  };
  const verdict = createMemo(() => {
    const found = props.check.found();
    return found && verdictOf(found);
  });
  const faults = createMemo(() => {
    const [found, { marks = {} }] = [props.check.found(), props.editor.editing().drawing];
    return found ? markFaults(marks, found) : [];
  });
  const isUsable = (): boolean => (props.check.found()?.regions ?? 0) > 0 && faults().length === 0;
  const show = async (drawing: Promise<Drawing>): Promise<void> =>
    props.editor.act({ type: 'show', drawing: await drawing });
  const take = (drawing: () => Promise<Drawing>) => attempt(show(drawing()));
  const start = (map: string) =>
    take(async () => (map === '' ? BLANK : drawingOf(await checkOfMap(map))));
  return (
    <>
      <section>
        <h2>{plainName()}</h2>
        <div class="form">
          <TextField
            label="Name"
            value={props.editor.name()}
            maxLength={34}
            onInput={props.editor.rename}
          />
        </div>
      </section>
      <section>
        <header>
          <h3>Check</h3>
          <Show when={verdict()}>
            {(one) => (
              <Badge
                of={one().isGood ? CheckIcon : TriangleAlert}
                tone={one().isGood ? 'good' : 'bad'}
              >
                {one().text}
              </Badge>
            )}
          </Show>
        </header>
        <div class="draw-check" role="status" aria-label="Check">
          <For each={props.check.remarks()}>
            {({ text, isWarning }) => <p classList={{ warning: isWarning }}>{text}</p>}
          </For>
          <For each={faults()}>{(text) => <p class="warning">{text}</p>}</For>
        </div>
      </section>
      <section>
        <h3>Begin with</h3>
        <div class="draw-row">
          <select
            aria-label="Begin with"
            disabled={isBusy()}
            onChange={(event) => {
              const { value } = event.currentTarget;
              event.currentTarget.value = '-';
              void start(value);
            }}
          >
            <option value="-" disabled selected>
              A map…
            </option>
            <option value="">an empty workspace</option>
            <For each={lab.catalog.maps()}>{(map) => <option value={map}>{map}</option>}</For>
          </select>
          <FileButton
            accept=".svg,image/svg+xml"
            inputName="Drawing to go on with"
            disabled={isBusy()}
            onFile={(file) =>
              void take(async () => {
                refuseLarge(file);
                return drawingOf(await checkOf(await file.text()));
              })
            }
          >
            Open SVG…
          </FileButton>
        </div>
        <p class="hint">This replaces the drawing. Undo brings it back.</p>
        <p class="refusal" role="alert">
          {refusal()}
        </p>
      </section>
      <footer class="inspector-foot">
        <button
          type="button"
          class="primary"
          disabled={!lab.canOperate() || isBusy() || !isUsable()}
          title="Adds the drawing to the server's maps and starts a trial on it"
          onClick={() => void props.onSave(fileOf(freeName(plainName(), lab.catalog.maps() ?? [])))}
        >
          Save and use
        </button>
        <button
          type="button"
          class="ghost"
          aria-label="Download SVG"
          title="Download SVG"
          onClick={() => {
            const drawn = fileOf(plainName());
            download(drawn.name, drawn);
          }}
        >
          <Icon of={Download} />
          SVG
        </button>
        <Show when={!lab.canOperate()}>
          <p class="hint">You are watching: take control to save the drawing here.</p>
        </Show>
      </footer>
    </>
  );
}

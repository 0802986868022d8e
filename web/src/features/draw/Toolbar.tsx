// The tools, their settings, and what can be done to the drawing as a whole.

import { For, Show, type JSX } from 'solid-js';
import { ChoiceField, FlagField } from '../../ui/fields/fields';
import { SYMMETRIES } from './drawing';
import type { Editor } from './editor';
import { type Brush, type Settings, SIZES_MM, type Step, type Tool } from './editing';
import { TOOL_KEYS } from './keys';

/** Id of the text that describes the tool. */
export const HELP_ID = 'draw-help';

const TOOLS: readonly (readonly [Tool, name: string, help: string])[] = [
  ['wall', 'Wall', 'Drag to draw by hand. Click for a corner; click it again to finish.'],
  ['post', 'Post', 'Click to put a post. Drag from its middle for another size.'],
  ['area', 'Area', 'Drag a rectangle. Click for a corner; click the first one to finish.'],
  ['erase', 'Erase', 'Drag over walls to cut them away.'],
  ['move', 'Move', 'Click a shape to select it. Drag it to another place.'],
];

const BRUSHES: Partial<Record<Tool, readonly [Brush, string]>> = {
  wall: ['wall', 'Width'],
  post: ['post', 'Diameter'],
  erase: ['erase', 'Width'],
};

const SNAP_MM = 5;

/** A button that changes the drawing as a whole, or what is begun or selected. */
interface Deed {
  readonly text: string;
  readonly name?: string;
  readonly title?: string;
  readonly can: (editor: Editor) => boolean;
  readonly act: (editor: Editor) => void;
}

const hasShapes = ({ editing }: Editor): boolean => editing().drawing.shapes.length > 0;
const isBegun = ({ editing }: Editor): boolean => editing().corners.length > 0;
const isSelected = ({ editing }: Editor): boolean => editing().selected !== undefined;
const step =
  (one: Step) =>
  ({ act }: Editor): void =>
    act(one);

const DEEDS: readonly (readonly Deed[])[] = [
  [
    { text: 'Undo', title: 'Ctrl+Z', can: (one) => one.canUndo(), act: (one) => one.undo() },
    { text: 'Redo', title: 'Ctrl+Y', can: (one) => one.canRedo(), act: (one) => one.redo() },
  ],
  [
    {
      text: 'Mirror ↔',
      name: 'Mirror left and right',
      title: 'Exchanges left and right, of the selected shape or of all',
      can: hasShapes,
      act: step({ type: 'mirror', axis: 'sides' }),
    },
    {
      text: 'Mirror ↕',
      name: 'Mirror top and bottom',
      title: 'Exchanges top and bottom, of the selected shape or of all',
      can: hasShapes,
      act: step({ type: 'mirror', axis: 'ends' }),
    },
  ],
  [
    { text: 'Delete', can: isSelected, act: step({ type: 'delete' }) },
    { text: 'Finish', can: isBegun, act: step({ type: 'finish' }) },
    { text: 'Cancel', can: isBegun, act: step({ type: 'cancel' }) },
  ],
];

function Size(props: { editor: Editor; brush: Brush; name: string }): JSX.Element {
  const size_mm = (): number => props.editor.editing().size_mm[props.brush];
  return (
    <label class="draw-size">
      <span>
        {props.name} <strong class="number">{size_mm()} mm</strong>
      </span>
      <input
        type="range"
        aria-label={props.name}
        min={SIZES_MM.least}
        max={SIZES_MM.most}
        step="1"
        value={size_mm()}
        onInput={(event) => {
          const sizes = { [props.brush]: event.currentTarget.valueAsNumber };
          const size_mm = { ...props.editor.editing().size_mm, ...sizes };
          props.editor.act({ type: 'set', settings: { size_mm } });
        }}
      />
    </label>
  );
}

export function Toolbar(props: { editor: Editor }): JSX.Element {
  const { editor } = props;
  const tool = (): Tool => editor.editing().tool;
  const set = (settings: Partial<Settings>): void => editor.act({ type: 'set', settings });
  const help = (): string => TOOLS.find(([name]) => name === tool())?.[2] ?? '';
  return (
    <section class="panel draw-tools" aria-label="Tools">
      <div class="draw-row" role="group" aria-label="Tool">
        <For each={TOOLS}>
          {([name, label, title]) => (
            <button
              type="button"
              aria-pressed={tool() === name}
              title={`${title} (${TOOL_KEYS[name].toUpperCase()})`}
              onClick={() => editor.act({ type: 'tool', tool: name })}
            >
              {label}
            </button>
          )}
        </For>
      </div>
      <p id={HELP_ID} class="draw-help">
        {help()}
      </p>
      <div class="draw-size-place">
        <Show when={BRUSHES[tool()]}>
          {(brush) => <Size editor={editor} brush={brush()[0]} name={brush()[1]} />}
        </Show>
      </div>
      <FlagField
        label={`Snap to ${SNAP_MM} mm`}
        value={editor.editing().snap_mm > 0}
        onChoose={(snaps) => set({ snap_mm: snaps ? SNAP_MM : 0 })}
      />
      <ChoiceField
        label="Symmetry"
        value={editor.editing().symmetry}
        options={SYMMETRIES}
        onChoose={(symmetry) => set({ symmetry })}
      />
      <For each={DEEDS}>
        {(row) => (
          <div class="draw-row">
            <For each={row}>
              {({ text, name, title, can, act }) => (
                <button
                  type="button"
                  aria-label={name}
                  title={title}
                  disabled={!can(editor)}
                  onClick={() => act(editor)}
                >
                  {text}
                </button>
              )}
            </For>
          </div>
        )}
      </For>
    </section>
  );
}

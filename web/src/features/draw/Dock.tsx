// The tools, their settings, and what can be done to the drawing as a whole.

import { For, Show, type JSX } from 'solid-js';
import { FlipHorizontal2, FlipVertical2, type IconNode, RotateCcw, RotateCw, Trash2 } from 'lucide';
import { ChoiceField } from '../../ui/fields/fields';
import { Icon } from '../../ui/Icon';
import { Segmented } from '../../ui/Segmented';
import { Toggle } from '../../ui/Toggle';
import { SYMMETRIES } from './drawing';
import type { Editor } from './editor';
import { type Brush, type Settings, SIZES_MM, type Step } from './editing';
import { TOOL_KEYS } from './keys';
import { brushOf, TOOLS } from './tools';

const SNAP_MM = 5;

/** A button that changes the drawing as a whole, or what is begun or selected. */
interface Deed {
  readonly text: string;
  readonly icon?: IconNode;
  readonly name?: string;
  readonly title?: string;
  readonly class?: string;
  readonly can: (editor: Editor) => boolean;
  /** Why it cannot be done. */
  readonly why: string;
  readonly act: (editor: Editor) => void;
}

const step =
  (one: Step) =>
  ({ act }: Editor): void =>
    act(one);
const whole = {
  can: ({ editing }: Editor): boolean => editing().drawing.shapes.length > 0,
  why: 'Nothing is drawn',
};
const begun = {
  can: ({ editing }: Editor): boolean => editing().corners.length > 0,
  why: 'Nothing is begun',
};

const HISTORY: readonly Deed[] = [
  {
    text: '',
    name: 'Undo',
    icon: RotateCcw,
    title: 'Undo (Ctrl+Z)',
    class: 'ghost icon-only',
    can: (one) => one.canUndo(),
    why: 'Nothing to undo',
    act: (one) => one.undo(),
  },
  {
    text: '',
    name: 'Redo',
    icon: RotateCw,
    title: 'Redo (Ctrl+Y)',
    class: 'ghost icon-only',
    can: (one) => one.canRedo(),
    why: 'Nothing to redo',
    act: (one) => one.redo(),
  },
];

const MIRRORS: readonly Deed[] = [
  {
    ...whole,
    text: 'Mirror',
    icon: FlipVertical2,
    name: 'Mirror left and right',
    title: 'Exchanges left and right, of the selected shape or of all',
    act: step({ type: 'mirror', axis: 'sides' }),
  },
  {
    ...whole,
    text: 'Mirror',
    icon: FlipHorizontal2,
    name: 'Mirror top and bottom',
    title: 'Exchanges top and bottom, of the selected shape or of all',
    act: step({ type: 'mirror', axis: 'ends' }),
  },
];

const ENDS: readonly Deed[] = [
  {
    text: 'Delete',
    icon: Trash2,
    class: 'ghost',
    can: ({ editing }) => editing().selected !== undefined,
    why: 'Nothing is selected',
    act: step({ type: 'delete' }),
  },
  { ...begun, text: 'Cancel', class: 'ghost', act: step({ type: 'cancel' }) },
  { ...begun, text: 'Finish', act: step({ type: 'finish' }) },
];

function Deeds(props: { editor: Editor; deeds: readonly Deed[] }): JSX.Element {
  return (
    <div class="draw-deeds">
      <For each={props.deeds}>
        {({ text, icon, name, title, can, why, act, ...rest }) => (
          <button
            type="button"
            class={rest.class}
            aria-label={name}
            title={can(props.editor) ? title : why}
            disabled={!can(props.editor)}
            onClick={() => act(props.editor)}
          >
            <Show when={icon}>{(one) => <Icon of={one()} />}</Show>
            {text}
          </button>
        )}
      </For>
    </div>
  );
}

function Size(props: { editor: Editor; brush: Brush; name: string }): JSX.Element {
  const size_mm = (): number => props.editor.editing().size_mm[props.brush];
  return (
    <label class="draw-size">
      <span>{props.name}</span>
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
      <strong class="number">{size_mm()} mm</strong>
    </label>
  );
}

export function Dock(props: { editor: Editor }): JSX.Element {
  const { editor } = props;
  const set = (settings: Partial<Settings>): void => editor.act({ type: 'set', settings });
  return (
    <>
      <div class="draw-settings">
        <Toggle
          isOn={editor.editing().snap_mm > 0}
          onChange={(snaps) => set({ snap_mm: snaps ? SNAP_MM : 0 })}
        >
          Snap to {SNAP_MM} mm
        </Toggle>
        <ChoiceField
          label="Symmetry"
          value={editor.editing().symmetry}
          options={SYMMETRIES}
          onChoose={(symmetry) => set({ symmetry })}
        />
        <Deeds editor={editor} deeds={MIRRORS} />
        <Show when={brushOf(editor.editing().tool)}>
          {(brush) => <Size editor={editor} brush={brush()[0]} name={brush()[1]} />}
        </Show>
      </div>
      <div class="transport draw-tools">
        <Segmented
          label="Tool"
          name="draw-tool"
          value={editor.editing().tool}
          segments={TOOLS.map(({ tool, name, icon, help }) => ({
            value: tool,
            label: (
              <>
                <Icon of={icon} />
                {name}
              </>
            ),
            help: `${help} (${TOOL_KEYS[tool].toUpperCase()})`,
          }))}
          onChoose={(tool) => editor.act({ type: 'tool', tool })}
        />
        <Deeds editor={editor} deeds={HISTORY} />
        <Deeds editor={editor} deeds={ENDS} />
      </div>
    </>
  );
}

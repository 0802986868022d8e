// The drawing by keyboard.

import type { Shortcut } from '../../ui/shortcuts';
import { clampedTo, type Mm } from './drawing';
import type { Editor } from './editor';
import type { Tool } from './editing';

export const TOOL_KEYS: Readonly<Record<Tool, string>> = {
  wall: 'w',
  post: 'p',
  area: 'a',
  erase: 'e',
  move: 'm',
  start: 's',
  goal: 'g',
};

/** Shown in the help. The drawing handles these keys itself. */
export const DRAW_SHORTCUTS: readonly Shortcut[] = [
  {
    group: 'Draw',
    keys: Object.values(TOOL_KEYS),
    does: 'wall, post, area, erase, move, start, goal',
  },
  {
    group: 'Draw',
    keys: ['ArrowLeft', 'ArrowUp', 'ArrowRight', 'ArrowDown'],
    does: 'move the cursor or the selected shape by 5 mm (Shift: 1 mm)',
  },
  { group: 'Draw', keys: ['Enter'], does: 'draw or select at the cursor; twice: finish' },
  { group: 'Draw', keys: ['Delete'], does: 'delete the selected shape' },
  { group: 'Draw', keys: ['Escape'], does: 'drop what is begun, or the selection' },
];

const STEP_MM = 5;
const FINE_MM = 1;
/** The cursor is exactly at its place. */
const SLOP_MM = 0.5;
const ARROWS: Partial<Record<string, Mm>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

function arrow(editor: Editor, [right, down]: Mm, step_mm: number): void {
  const { tool, selected, drawing } = editor.editing();
  const by: Mm = [right * step_mm, down * step_mm];
  if (tool === 'move' && selected !== undefined) {
    editor.act({ type: 'nudge', by });
    return;
  }
  const { x_mm, y_mm, width_mm, height_mm } = drawing.frame;
  const from = editor.pointer() ?? [x_mm + width_mm / 2, y_mm + height_mm / 2];
  const onGrid = (value: number): number => Math.round(value / step_mm) * step_mm;
  editor.point(clampedTo(drawing.frame, [onGrid(from[0] + by[0]), onGrid(from[1] + by[1])]));
}

/** A key while the drawing has the focus. */
export function onKey(editor: Editor, event: KeyboardEvent): void {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const isDragging = editor.editing().trace.length > 0;
  if (isDragging && event.key !== 'Escape') return;
  const direction = ARROWS[event.key];
  const tool = (Object.keys(TOOL_KEYS) as Tool[]).find(
    (name) => TOOL_KEYS[name] === event.key.toLowerCase(),
  );
  const at = editor.pointer();
  if (direction) arrow(editor, direction, event.shiftKey ? FINE_MM : STEP_MM);
  else if (tool) editor.act({ type: 'tool', tool });
  else if (event.key === 'Enter' && at) editor.act({ type: 'click', at, slop_mm: SLOP_MM });
  else if (event.key === 'Delete' || event.key === 'Backspace') editor.act({ type: 'delete' });
  else if (event.key === 'Escape') editor.act({ type: 'cancel' });
  else return;
  event.preventDefault();
}

/** Undo and redo, wherever the focus is, except in text. */
export function onUndoKey(editor: Editor, event: KeyboardEvent): void {
  const isText = event.target instanceof HTMLInputElement && event.target.type === 'text';
  if (isText || event.altKey || !(event.ctrlKey || event.metaKey)) return;
  const key = event.key.toLowerCase();
  if (key === 'z' && !event.shiftKey) editor.undo();
  else if (key === 'y' || key === 'z') editor.redo();
  else return;
  event.preventDefault();
}

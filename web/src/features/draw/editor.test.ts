import { beforeEach, expect, it, vi } from 'vitest';
import { createEditor } from './editor';
import type { Step } from './editing';

beforeEach(() => {
  vi.stubGlobal('localStorage', { getItem: () => null, setItem: () => undefined });
});

const click = (x: number, y: number): Step => ({ type: 'click', at: [x, y], slop_mm: 2 });
const post = (x: number): Step[] => [{ type: 'tool', tool: 'post' }, click(x, 300)];

function editorAfter(...steps: Step[]) {
  const editor = createEditor();
  steps.forEach(editor.act);
  const count = (): number => editor.editing().drawing.shapes.length;
  return { editor, count };
}

it('takes shapes back, one corner at a time while a wall is begun', () => {
  const { editor, count } = editorAfter(
    ...post(0),
    { type: 'tool', tool: 'wall' },
    click(0, 400),
    click(50, 400),
  );
  editor.undo();
  expect(editor.editing().corners).toHaveLength(1);
  editor.redo();
  expect([editor.editing().corners.length, editor.canRedo()]).toEqual([1, false]);
  editor.undo();
  editor.undo();
  expect([count(), editor.canUndo(), editor.canRedo()]).toEqual([0, false, true]);
  editor.redo();
  expect(count()).toBe(1);
});

it('keeps what can be done again when the eraser meets nothing', () => {
  const { editor, count } = editorAfter(...post(0));
  editor.undo();
  editor.act({ type: 'tool', tool: 'erase' });
  editor.act(click(-200, 300));
  editor.redo();
  expect(count()).toBe(1);
});

it('undoes held arrow keys at once', () => {
  const { editor } = editorAfter(...post(0), { type: 'tool', tool: 'move' }, click(0, 300));
  for (let i = 0; i < 300; i += 1) editor.act({ type: 'nudge', by: [-5, 0] });
  expect(editor.editing().drawing.shapes).toMatchObject([{ center: [-300, 300] }]);
  editor.undo();
  expect(editor.editing().drawing.shapes).toMatchObject([{ center: [0, 300] }]);
});

it('cancels a drag instead of undoing', () => {
  const { editor, count } = editorAfter(...post(0), { type: 'tool', tool: 'wall' });
  for (const x of [0, 50]) editor.act({ type: 'drag', at: [x, 400], slop_mm: 2 });
  editor.undo();
  editor.act({ type: 'drop' });
  expect([count(), editor.editing().trace.length]).toEqual([1, 0]);
});

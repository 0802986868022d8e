// The drawing that is being edited, with undo, and where the pointer or the keyboard's cursor is.

import { createSignal } from 'solid-js';
import { amended, onward, redone, startOf, type Undo, undone } from '../../ui/undo';
import { recall, remember } from '../../ui/storage';
import { draftFrom } from './draft';
import { BLANK, type Drawing, type Mm } from './drawing';
import { after, begin, type Step } from './editing';

/** Of the draft in the browser's storage. */
const KEY = 'drawing';
const DEFAULT_NAME = 'my-maze';

/** Begins with the draft of the last visit, if there is one. */
export function createEditor() {
  const first = draftFrom(recall(KEY)) ?? BLANK;
  const [editing, setEditing] = createSignal(begin(first));
  const [history, setHistory] = createSignal(startOf(first));
  const [pointer, point] = createSignal<Mm>();
  const [name, rename] = createSignal(DEFAULT_NAME);
  let last: Step['type'] | undefined;
  const keep = (undo: Undo<Drawing>): void => {
    setHistory(undo);
    remember(KEY, JSON.stringify(undo.present));
  };
  const show = (undo: Undo<Drawing>): void => {
    last = undefined;
    keep(undo);
    setEditing((now) => after(now, { type: 'show', drawing: undo.present }));
  };
  const act = (step: Step): void => {
    const before = editing().drawing;
    const { drawing } = setEditing((now) => after(now, step));
    // Held arrow keys are one change.
    const goesOn = step.type === 'nudge' && last === 'nudge';
    last = step.type;
    if (drawing !== before) keep((goesOn ? amended : onward)(history(), drawing));
  };
  const isDragging = (): boolean => editing().trace.length > 0;
  const isBegun = (): boolean => editing().corners.length > 0;
  const canRedo = (): boolean => !isBegun() && !isDragging() && history().future.length > 0;
  return {
    editing,
    pointer,
    point,
    name,
    rename,
    act,
    undo: (): void => {
      if (isDragging()) act({ type: 'cancel' });
      else if (isBegun()) act({ type: 'back' });
      else show(undone(history()));
    },
    redo: (): void => {
      if (canRedo()) show(redone(history()));
    },
    canUndo: (): boolean => isBegun() || history().past.length > 0,
    canRedo,
  };
}

export type Editor = ReturnType<typeof createEditor>;

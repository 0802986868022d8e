// The drawing that is being edited, with undo, and where the pointer or the keyboard's cursor is.

import { createSignal, type Accessor } from 'solid-js';
import { onward, redone, startOf, type Undo, undone } from '../../ui/undo';
import { recallDraft, rememberDraft } from './draft';
import { BLANK, type Drawing, type Mm } from './drawing';
import { after, begin, type Editing, type Step } from './editing';

export interface Editor {
  readonly editing: Accessor<Editing>;
  readonly pointer: Accessor<Mm | undefined>;
  readonly point: (at: Mm | undefined) => void;
  readonly act: (step: Step) => void;
  readonly undo: () => void;
  readonly redo: () => void;
  readonly canUndo: Accessor<boolean>;
  readonly canRedo: Accessor<boolean>;
}

/** Goes on with the draft of the last visit, if there is one. */
export function createEditor(): Editor {
  const first = recallDraft() ?? BLANK;
  const [editing, setEditing] = createSignal(begin(first));
  const [history, setHistory] = createSignal(startOf(first));
  const [pointer, point] = createSignal<Mm>();
  const travel = (to: (undo: Undo<Drawing>) => Undo<Drawing>): void => {
    const next = setHistory(to);
    setEditing((now) => after(now, { type: 'show', drawing: next.present }));
    rememberDraft(next.present);
  };
  const act = (step: Step): void => {
    const before = editing().drawing;
    const { drawing } = setEditing((now) => after(now, step));
    if (drawing === before) return;
    setHistory((undo) => onward(undo, drawing));
    rememberDraft(drawing);
  };
  return {
    editing,
    pointer,
    point,
    act,
    undo: () => {
      if (editing().corners.length > 0) act({ type: 'back' });
      else travel(undone);
    },
    redo: () => {
      travel(redone);
    },
    canUndo: () => editing().corners.length > 0 || history().past.length > 0,
    canRedo: () => history().future.length > 0,
  };
}

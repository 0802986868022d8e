// What opens below a button and goes away by itself: at Escape, at a press elsewhere, when the keyboard goes on.

import { createEffect, createSignal, onCleanup, type Accessor } from 'solid-js';

export interface Popover {
  readonly open: Accessor<boolean>;
  readonly setOpen: (open: boolean) => void;
  /** For the element that holds both button and content. */
  readonly onFocusOut: (event: FocusEvent) => void;
}

export function createPopover(box: () => HTMLElement, button: () => HTMLButtonElement): Popover {
  const [open, setOpen] = createSignal(false);
  createEffect(() => {
    if (!open()) return;
    const onDown = (event: PointerEvent): void => {
      if (box().contains(event.target as Node)) return;
      setOpen(false);
      // A click that is to close it is to place no goal. Buttons hear of the click all the same.
      event.stopPropagation();
    };
    const onKey = (event: KeyboardEvent): void => {
      if (event.key !== 'Escape') return;
      // What has the focus is about to go.
      if (box().contains(document.activeElement)) button().focus();
      setOpen(false);
    };
    document.addEventListener('pointerdown', onDown, true);
    document.addEventListener('keydown', onKey);
    onCleanup(() => {
      document.removeEventListener('pointerdown', onDown, true);
      document.removeEventListener('keydown', onKey);
    });
  });
  return {
    open,
    setOpen,
    onFocusOut: ({ relatedTarget }) => {
      // The keyboard went on; a click beside what can have it focuses nothing.
      if (relatedTarget && !box().contains(relatedTarget as Node)) setOpen(false);
    },
  };
}

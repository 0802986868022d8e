// A popover below a button. It closes on Escape, on a press elsewhere, and when the focus leaves it.

import { createEffect, createSignal } from 'solid-js';
import { listen } from './listen';

export function createPopover(box: () => HTMLElement, button: () => HTMLButtonElement) {
  const [open, setOpen] = createSignal(false);
  createEffect(() => {
    if (!open()) return;
    const onDown = (event: PointerEvent): void => {
      if (box().contains(event.target as Node)) return;
      setOpen(false);
      // A press that closes the popover must not set a goal. Buttons still get the click.
      event.stopPropagation();
    };
    listen('pointerdown', onDown, { capture: true });
    listen('keydown', (event) => {
      if (event.key !== 'Escape') return;
      // The focused element is about to be removed.
      if (box().contains(document.activeElement)) button().focus();
      setOpen(false);
    });
  });
  return {
    open,
    setOpen,
    /** Of the element that contains both button and content. */
    onFocusOut: ({ relatedTarget }: FocusEvent) => {
      // The focus moved on. Without a new target, a click on something that cannot have focus caused this.
      if (relatedTarget && !box().contains(relatedTarget as Node)) setOpen(false);
    },
  };
}

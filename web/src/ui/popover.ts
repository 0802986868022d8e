// A popover below a button. It closes on Escape, on a press elsewhere, and when the focus leaves it.

import { createEffect, createSignal } from 'solid-js';
import { listen } from './listen';
import './popover.css';

/** `id` is that of the content. `box` are attributes of the element with both button and content. */
export function createPopover(id: string) {
  let box!: HTMLElement;
  let button!: HTMLButtonElement;
  const [open, setOpen] = createSignal(false);
  /** The focused element is about to be removed. */
  const close = (): void => {
    if (box.contains(document.activeElement)) button.focus();
    setOpen(false);
  };
  createEffect(() => {
    if (!open()) return;
    const onDown = (event: PointerEvent): void => {
      if (box.contains(event.target as Node)) return;
      setOpen(false);
      // A press that closes the popover must not set a goal. Buttons still get the click.
      event.stopPropagation();
    };
    listen('pointerdown', onDown, { capture: true });
    listen('keydown', (event) => {
      if (event.key === 'Escape') close();
    });
  });
  return {
    open,
    close,
    /** The button as it is in the document. */
    element: (): HTMLButtonElement => button,
    box: {
      ref: (element: HTMLElement): void => {
        box = element;
      },
      onFocusOut: ({ relatedTarget }: FocusEvent): void => {
        // The focus moved on. Without a new target, a click on something that cannot have focus caused this.
        if (relatedTarget && !box.contains(relatedTarget as Node)) setOpen(false);
      },
    },
    button: {
      ref: (element: HTMLButtonElement): void => {
        button = element;
      },
      type: 'button' as const,
      'aria-controls': id,
      get 'aria-expanded'() {
        return open();
      },
      onClick: (): void => {
        setOpen(!open());
      },
    },
  };
}

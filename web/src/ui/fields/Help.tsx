// A button that shows a text beside it, also for touch and keyboard.

import { createEffect, createSignal, type JSX } from 'solid-js';
import { listen } from '../listen';
import { createPopover } from '../popover';

const GAP_PX = 8;

export function Help(props: { id: string; of: string; text: string }): JSX.Element {
  let box!: HTMLSpanElement;
  let button!: HTMLButtonElement;
  let text!: HTMLSpanElement;
  const { open, setOpen, onFocusOut } = createPopover(
    () => box,
    () => button,
  );
  const [place, setPlace] = createSignal({ left: '0', top: '0' });
  // Panels scroll and would cut it off, so its place is one in the window.
  const put = (): void => {
    const at = button.getBoundingClientRect();
    const { width, height } = text.getBoundingClientRect();
    const left = Math.max(GAP_PX, Math.min(at.left, innerWidth - width - GAP_PX));
    const isBelow = at.bottom + height + GAP_PX <= innerHeight;
    setPlace({ left: `${left}px`, top: `${isBelow ? at.bottom : at.top - height}px` });
  };
  createEffect(() => {
    if (!open()) return;
    put();
    listen('scroll', put, { capture: true });
    listen('resize', put);
  });
  return (
    <span ref={box} class="help" onFocusOut={onFocusOut}>
      <button
        ref={button}
        type="button"
        class="help-button"
        aria-expanded={open()}
        aria-controls={props.id}
        onClick={() => {
          setOpen(!open());
        }}
      >
        <span class="visually-hidden">Help: {props.of}</span>
      </button>
      <span ref={text} id={props.id} class="help-text" hidden={!open()} style={place()}>
        {props.text}
      </span>
    </span>
  );
}

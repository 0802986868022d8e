// A button that shows a text beside it, also for touch and keyboard.

import { createEffect, createSignal, type JSX } from 'solid-js';
import { listen } from '../listen';
import { createPopover } from '../popover';

const GAP_PX = 8;

export function Help(props: { id: string; of: string; text: string }): JSX.Element {
  let text!: HTMLSpanElement;
  const popover = createPopover(props.id);
  const [place, setPlace] = createSignal({ left: '0', top: '0' });
  // Panels scroll and would cut it off, so its place is one in the window.
  const put = (): void => {
    const at = popover.element().getBoundingClientRect();
    const { width, height } = text.getBoundingClientRect();
    const left = Math.max(GAP_PX, Math.min(at.left, innerWidth - width - GAP_PX));
    const isBelow = at.bottom + height + GAP_PX <= innerHeight;
    setPlace({ left: `${left}px`, top: `${isBelow ? at.bottom : at.top - height}px` });
  };
  createEffect(() => {
    if (!popover.open()) return;
    put();
    listen('scroll', put, { capture: true });
    listen('resize', put);
  });
  return (
    <span {...popover.box} class="help">
      <button {...popover.button} class="help-button">
        <span class="visually-hidden">Help: {props.of}</span>
      </button>
      <span ref={text} id={props.id} class="help-text" hidden={!popover.open()} style={place()}>
        {props.text}
      </span>
    </span>
  );
}

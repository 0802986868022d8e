// The inspector as a sheet over the map of a phone: half as high as the map, or nearly as high.

import { createEffect, createSignal, on, type Accessor } from 'solid-js';

/** A shorter movement of the handle is a tap. */
const SLOP_PX = 12;

/** `needsHeight` makes it high at first; `close` is called when the half sheet is pulled down. */
export function createSheet(needsHeight: Accessor<boolean>, close: () => void) {
  const [isTall, setTall] = createSignal(false);
  createEffect(on(needsHeight, setTall));
  let from_px: number | undefined;
  let isPulled = false;
  return {
    isTall,
    handle: {
      get 'aria-expanded'() {
        return isTall();
      },
      onPointerDown: (event: PointerEvent & { currentTarget: HTMLElement }): void => {
        event.currentTarget.setPointerCapture(event.pointerId);
        from_px = event.clientY;
        isPulled = false;
      },
      onPointerUp: ({ clientY }: PointerEvent): void => {
        const moved_px = clientY - (from_px ?? clientY);
        isPulled = Math.abs(moved_px) > SLOP_PX;
        if (!isPulled) return;
        if (moved_px > 0 && !isTall()) close();
        setTall(moved_px < 0);
      },
      /** A mouse also clicks after a pull; a key never pulls. */
      onClick: ({ detail }: MouseEvent): void => {
        if (!isPulled || detail === 0) setTall(!isTall());
      },
    },
  };
}

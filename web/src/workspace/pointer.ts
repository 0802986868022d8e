// Mouse, pen and finger on the workspace.

import { onCleanup } from 'solid-js';
import type { Lab } from '../lab';
import { distance, pxFromWorld, type Vec2, type View } from '../transform';
import type { Hand } from './hand';

/** How near the bead a press takes it. */
export const GRAB_MOUSE_PX = 16;
export const GRAB_TOUCH_PX = 28;
const SLOP_MOUSE_PX = 3;
/** A fingertip rolls farther than a mouse slips. */
const SLOP_TOUCH_PX = 8;

export interface Pointing {
  /** Pointer in CSS pixels of the canvas. */
  readonly at: Vec2;
  /** How near the bead it takes it. */
  readonly reachPx: number;
}

const isTouch = (event: PointerEvent): boolean => event.pointerType === 'touch';

/** Whether a pointer is so near the bead that a press takes it; the bead may move and the pointer rest. */
export function reachesBead(
  view: View | undefined,
  bead_m: readonly [number, number, number] | undefined,
  { at, reachPx }: Pointing,
): boolean {
  if (!view || !bead_m) return false;
  return distance(at, pxFromWorld(view, [bead_m[0], bead_m[1]])) <= reachPx;
}

/** Listens until the owner is gone, and then lets go. */
export function attachPointer(
  canvas: HTMLCanvasElement,
  lab: Lab,
  hand: Hand,
  view: () => View | undefined,
  onPointing: (pointing: Pointing | undefined) => void,
): void {
  const gone = new AbortController();
  const { signal } = gone;
  const position = (event: PointerEvent): Vec2 => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const pointing = (event: PointerEvent): Pointing => ({
    at: position(event),
    reachPx: isTouch(event) ? GRAB_TOUCH_PX : GRAB_MOUSE_PX,
  });

  canvas.addEventListener(
    'pointerdown',
    (event) => {
      if (event.button !== 0 || !hand.mayAct()) return;
      canvas.setPointerCapture(event.pointerId);
      const here = pointing(event);
      hand.dispatch({
        type: 'down',
        pointer: event.pointerId,
        at: here.at,
        onBead: reachesBead(view(), lab.state()?.bead_m, here),
        slopPx: isTouch(event) ? SLOP_TOUCH_PX : SLOP_MOUSE_PX,
      });
      onPointing(here);
    },
    { signal },
  );
  canvas.addEventListener(
    'pointermove',
    (event) => {
      hand.dispatch({
        type: 'move',
        by: event.pointerId,
        at: position(event),
        lift: event.shiftKey,
      });
      onPointing(pointing(event));
    },
    { signal },
  );
  canvas.addEventListener(
    'pointerup',
    (event) => {
      hand.dispatch({ type: 'up', pointer: event.pointerId });
    },
    { signal },
  );
  canvas.addEventListener(
    'pointerleave',
    () => {
      onPointing(undefined);
    },
    { signal },
  );
  // A long press of a finger that holds the bead asks for no menu.
  canvas.addEventListener(
    'contextmenu',
    (event) => {
      if (hand.drag().kind !== 'idle') event.preventDefault();
    },
    { signal },
  );

  const cancel = (): void => {
    hand.dispatch({ type: 'cancel' });
  };
  canvas.addEventListener('pointercancel', cancel, { signal });
  canvas.addEventListener(
    'lostpointercapture',
    () => {
      // The keyboard's hold has no capture to lose.
      const drag = hand.drag();
      if (drag.kind === 'pressed' || (drag.kind === 'held' && drag.by !== 'keyboard')) cancel();
    },
    { signal },
  );
  window.addEventListener('blur', cancel, { signal });
  document.addEventListener(
    'visibilitychange',
    () => {
      if (document.hidden) cancel();
    },
    { signal },
  );
  const shift = (event: KeyboardEvent): void => {
    if (event.key === 'Shift') hand.dispatch({ type: 'lift', lift: event.type === 'keydown' });
  };
  window.addEventListener('keydown', shift, { signal });
  window.addEventListener('keyup', shift, { signal });
  onCleanup(() => {
    gone.abort();
    cancel();
  });
}

// Mouse, pen and finger on the workspace.

import type { Hand } from './hand';
import { distance, type TableView, type Vec2 } from '../lab/geometry';
import type { Trial } from '../lab/slices';

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

type PointerEventName =
  | 'pointerdown'
  | 'pointermove'
  | 'pointerup'
  | 'pointerleave'
  | 'pointercancel'
  | 'lostpointercapture'
  | 'contextmenu';

const isTouch = (event: PointerEvent): boolean => event.pointerType === 'touch';

/** Whether a pointer is so near the bead that a press takes it; the bead may move and the pointer rest. */
export function reachesBead(
  view: TableView | undefined,
  bead_m: readonly [number, number, number] | undefined,
  { at, reachPx }: Pointing,
): boolean {
  const bead = bead_m && view?.toPx([bead_m[0], bead_m[1]], bead_m[2]);
  return bead !== undefined && distance(at, bead) <= reachPx;
}

/** Listens until the function that it returns is called. */
export function attachPointer(
  canvas: HTMLCanvasElement,
  lab: Trial,
  hand: Hand,
  view: () => TableView | undefined,
  onPointing: (pointing: Pointing | undefined) => void,
): () => void {
  const attached = new AbortController();
  const { signal } = attached;
  const position = (event: PointerEvent): Vec2 => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const pointing = (event: PointerEvent): Pointing => ({
    at: position(event),
    reachPx: isTouch(event) ? GRAB_TOUCH_PX : GRAB_MOUSE_PX,
  });
  const listen = (type: PointerEventName, listener: (event: PointerEvent) => void): void => {
    canvas.addEventListener(type, listener, { signal });
  };

  listen('pointerdown', (event) => {
    if (event.button !== 0) return;
    const here = pointing(event);
    const onBead = reachesBead(view(), lab.state()?.bead_m, here);
    if (onBead && !hand.mayAct()) return;
    canvas.setPointerCapture(event.pointerId);
    hand.dispatch({
      type: 'down',
      pointer: event.pointerId,
      at: here.at,
      onBead,
      slopPx: isTouch(event) ? SLOP_TOUCH_PX : SLOP_MOUSE_PX,
    });
    onPointing(here);
  });
  listen('pointermove', (event) => {
    hand.dispatch({
      type: 'move',
      by: event.pointerId,
      at: position(event),
      lift: event.shiftKey,
    });
    onPointing(pointing(event));
  });
  listen('pointerup', (event) => {
    hand.dispatch({ type: 'up', pointer: event.pointerId });
  });
  listen('pointerleave', () => {
    onPointing(undefined);
  });
  // A long press of a finger that holds the bead asks for no menu.
  listen('contextmenu', (event) => {
    if (hand.drag().kind !== 'idle') event.preventDefault();
  });

  const cancel = (): void => {
    hand.dispatch({ type: 'cancel' });
  };
  listen('pointercancel', cancel);
  listen('lostpointercapture', ({ pointerId }) => {
    // Neither a second finger's capture nor the keyboard's hold, which has none, is what holds the bead.
    const drag = hand.drag();
    if (drag.kind === 'pressed' && drag.pointer === pointerId) cancel();
    if (drag.kind === 'held' && drag.by === pointerId) cancel();
  });
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
  return () => {
    attached.abort();
  };
}

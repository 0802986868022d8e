// Mouse, pen and finger on the workspace.

import type { Lab } from '../lab';
import { distance, type TableView, type Vec2 } from '../transform';
import type { Hand } from './hand';

/** How near the bead a press takes it. */
export const GRAB_MOUSE_PX = 16;
export const GRAB_TOUCH_PX = 28;
const SLOP_MOUSE_PX = 3;
/** A fingertip rolls farther than a mouse slips. */
const SLOP_TOUCH_PX = 8;

export interface Pointing {
  /** Pointer in CSS pixels of the canvas; none when it is elsewhere. */
  readonly at: Vec2 | undefined;
  readonly nearBead: boolean;
}

export const NOWHERE: Pointing = { at: undefined, nearBead: false };

type PointerEventName =
  | 'pointerdown'
  | 'pointermove'
  | 'pointerup'
  | 'pointerleave'
  | 'pointercancel'
  | 'lostpointercapture';

const isTouch = (event: PointerEvent): boolean => event.pointerType === 'touch';

/** Listens until the function that it returns is called. */
export function attachPointer(
  canvas: HTMLCanvasElement,
  lab: Lab,
  hand: Hand,
  view: () => TableView | undefined,
  onPointing: (pointing: Pointing) => void,
): () => void {
  const attached = new AbortController();
  const { signal } = attached;
  const position = (event: PointerEvent): Vec2 => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const nearBead = (at: Vec2, reachPx: number): boolean => {
    const bead_m = lab.state()?.bead_m;
    const bead = bead_m && view()?.toPx([bead_m[0], bead_m[1]], bead_m[2]);
    return bead !== undefined && distance(at, bead) <= reachPx;
  };
  const point = (event: PointerEvent): void => {
    const at = position(event);
    onPointing({ at, nearBead: lab.canOperate() && nearBead(at, GRAB_MOUSE_PX) });
  };
  const listen = (type: PointerEventName, listener: (event: PointerEvent) => void): void => {
    canvas.addEventListener(type, listener, { signal });
  };

  listen('pointerdown', (event) => {
    if (event.button !== 0) return;
    const at = position(event);
    const onBead = nearBead(at, isTouch(event) ? GRAB_TOUCH_PX : GRAB_MOUSE_PX);
    if (onBead && !hand.mayAct()) return;
    canvas.setPointerCapture(event.pointerId);
    hand.dispatch({
      type: 'down',
      pointer: event.pointerId,
      at,
      onBead,
      slopPx: isTouch(event) ? SLOP_TOUCH_PX : SLOP_MOUSE_PX,
    });
    point(event);
  });
  listen('pointermove', (event) => {
    hand.dispatch({
      type: 'move',
      by: event.pointerId,
      at: position(event),
      lift: event.shiftKey,
    });
    point(event);
  });
  listen('pointerup', (event) => {
    hand.dispatch({ type: 'up', pointer: event.pointerId });
  });
  listen('pointerleave', () => {
    onPointing(NOWHERE);
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

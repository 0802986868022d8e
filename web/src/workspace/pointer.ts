// Mouse, pen and finger on the workspace.

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
  /** Pointer in CSS pixels of the canvas; none when it is elsewhere. */
  readonly at: Vec2 | undefined;
  readonly nearBead: boolean;
}

const isTouch = (event: PointerEvent): boolean => event.pointerType === 'touch';

export function attachPointer(
  canvas: HTMLCanvasElement,
  lab: Lab,
  hand: Hand,
  view: () => View | undefined,
  onPointing: (pointing: Pointing) => void,
): void {
  const position = (event: PointerEvent): Vec2 => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const nearBead = (at: Vec2, reachPx: number): boolean => {
    const state = lab.state();
    const now = view();
    if (!state || !now) return false;
    return distance(at, pxFromWorld(now, [state.bead_m[0], state.bead_m[1]])) <= reachPx;
  };
  const point = (event: PointerEvent): void => {
    const at = position(event);
    onPointing({ at, nearBead: lab.canOperate() && nearBead(at, GRAB_MOUSE_PX) });
  };

  canvas.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || !hand.mayAct()) return;
    canvas.setPointerCapture(event.pointerId);
    const at = position(event);
    hand.dispatch({
      type: 'down',
      pointer: event.pointerId,
      at,
      onBead: nearBead(at, isTouch(event) ? GRAB_TOUCH_PX : GRAB_MOUSE_PX),
      slopPx: isTouch(event) ? SLOP_TOUCH_PX : SLOP_MOUSE_PX,
    });
    point(event);
  });
  canvas.addEventListener('pointermove', (event) => {
    hand.dispatch({
      type: 'move',
      by: event.pointerId,
      at: position(event),
      lift: event.shiftKey,
    });
    point(event);
  });
  canvas.addEventListener('pointerup', (event) => {
    hand.dispatch({ type: 'up', pointer: event.pointerId });
  });
  canvas.addEventListener('pointerleave', () => {
    onPointing({ at: undefined, nearBead: false });
  });

  const cancel = (): void => {
    hand.dispatch({ type: 'cancel' });
  };
  canvas.addEventListener('pointercancel', cancel);
  canvas.addEventListener('lostpointercapture', () => {
    // The keyboard's hold has no capture to lose.
    const drag = hand.drag();
    if (drag.kind === 'pressed' || (drag.kind === 'held' && drag.by !== 'keyboard')) cancel();
  });
  window.addEventListener('blur', cancel);
  document.addEventListener('visibilitychange', () => {
    if (document.hidden) cancel();
  });
  const shift = (event: KeyboardEvent): void => {
    if (event.key === 'Shift') hand.dispatch({ type: 'lift', lift: event.type === 'keydown' });
  };
  window.addEventListener('keydown', shift);
  window.addEventListener('keyup', shift);
}

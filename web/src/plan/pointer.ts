// Mouse, pen and finger on the workspace. Converts pixels to metres of the table for the hand.

import { createEffect, on } from 'solid-js';
import { distance, type TableView, type Vec2 } from '../lab/geometry';
import type { Trial } from '../lab/slices';
import type { Hand } from './hand';
import { releaseWithPage } from './release';

/** Largest distance from the bead at which a press grabs it. */
export const GRAB_MOUSE_PX = 16;
export const GRAB_TOUCH_PX = 28;
/** A shorter movement is still a click. */
const SLOP_MOUSE_PX = 3;
/** Larger for a finger, because a fingertip rolls. */
const SLOP_TOUCH_PX = 8;

export interface Pointing {
  /** Pointer in CSS pixels of the canvas. */
  readonly px: Vec2;
  /** Largest distance from the bead at which this pointer grabs it. */
  readonly reachPx: number;
}

type PointerEventName =
  'pointerdown' | 'pointermove' | 'pointerup' | 'pointerleave' | 'contextmenu';

const isTouch = (event: PointerEvent): boolean => event.pointerType === 'touch';

/** Whether a press would grab the bead. The bead may move while the pointer does not. */
export function reachesBead(
  view: TableView | undefined,
  bead_m: readonly [number, number, number] | undefined,
  { px, reachPx }: Pointing,
): boolean {
  const bead = bead_m && view?.toPx([bead_m[0], bead_m[1]], bead_m[2]);
  return bead !== undefined && distance(px, bead) <= reachPx;
}

/** Listens and follows the view until the returned function is called. */
export function attachPointer(
  canvas: HTMLCanvasElement,
  lab: Trial,
  hand: Hand,
  view: () => TableView | undefined,
  onPointing: (pointing: Pointing | undefined) => void,
  grabPx?: number,
): () => void {
  const attached = new AbortController();
  const { signal } = attached;
  /** The pointer that pressed, where it was then, and where it is. */
  let press: { id: number; from: Vec2; slopPx: number; px: Vec2; lift: boolean } | undefined;
  const pointing = (event: PointerEvent): Pointing => {
    const box = canvas.getBoundingClientRect();
    return {
      px: [event.clientX - box.left, event.clientY - box.top],
      reachPx: grabPx ?? (isTouch(event) ? GRAB_TOUCH_PX : GRAB_MOUSE_PX),
    };
  };
  const move = (): void => {
    if (!press) return;
    const { id, from, slopPx, px, lift } = press;
    const isBeyondSlop = distance(from, px) > slopPx;
    hand.dispatch({ type: 'move', by: id, at: view()?.toWorld(px), isBeyondSlop, lift });
  };
  const listen = (type: PointerEventName, listener: (event: PointerEvent) => void): void => {
    canvas.addEventListener(type, listener, { signal });
  };
  listen('pointerdown', (event) => {
    if (event.button !== 0) return;
    const here = pointing(event);
    const onBead = reachesBead(view(), lab.state()?.bead_m, here);
    if (onBead && !hand.mayAct()) return;
    canvas.setPointerCapture(event.pointerId);
    onPointing(here);
    const at = view()?.toWorld(here.px);
    if (!at || hand.drag().kind !== 'idle') return;
    press = {
      id: event.pointerId,
      from: here.px,
      slopPx: isTouch(event) ? SLOP_TOUCH_PX : SLOP_MOUSE_PX,
      px: here.px,
      lift: event.shiftKey,
    };
    hand.dispatch({ type: 'down', pointer: event.pointerId, at, onBead });
  });
  listen('pointermove', (event) => {
    const here = pointing(event);
    if (press?.id === event.pointerId) {
      press.px = here.px;
      press.lift = event.shiftKey;
      move();
    }
    onPointing(here);
  });
  listen('pointerup', (event) => {
    hand.dispatch({ type: 'up', pointer: event.pointerId });
    if (press?.id === event.pointerId) press = undefined;
  });
  listen('pointerleave', () => {
    onPointing(undefined);
  });
  // A long press of a finger that holds the bead opens no menu.
  listen('contextmenu', (event) => {
    if (hand.drag().kind !== 'idle') event.preventDefault();
  });
  releaseWithPage(canvas, hand.release, signal);
  // When the view changes, the place under a still pointer changes.
  createEffect(
    on(view, () => {
      const drag = hand.drag();
      if (drag.kind === 'held' && drag.by === press?.id) move();
    }),
  );
  const shift = (event: KeyboardEvent): void => {
    if (event.key !== 'Shift') return;
    const lift = event.type === 'keydown';
    if (press) press.lift = lift;
    hand.dispatch({ type: 'lift', lift });
  };
  window.addEventListener('keydown', shift, { signal });
  window.addEventListener('keyup', shift, { signal });
  return () => {
    attached.abort();
  };
}

// Wheel, two fingers, drag and keys zoom and move the plan view.

import { distance, type Vec2 } from '../lab/geometry';
import type { Shortcut } from '../ui/shortcuts';
import type { Hand } from './hand';
import { type Frame, WHOLE, type Zoom, panBy, zoomAt } from './zoom';

/** Shown in the help. */
export const ZOOM_SHORTCUTS: readonly Shortcut[] = [
  { group: 'Workspace', keys: ['+', '-'], does: 'zoom the plan' },
  { group: 'Workspace', keys: ['Home'], does: 'show the whole plan' },
];

/** Zoom per pixel of the wheel. */
const WHEEL = 1.0015;
const KEY = 1.25;
/** A shorter movement of a finger may still be a tap. */
const SLOP_PX = 8;

export interface Zooming {
  readonly frame: () => Frame | undefined;
  readonly zoom: () => Zoom;
  readonly setZoom: (zoom: Zoom) => void;
}

/** Listens while the canvas exists, after the listeners of the hand. */
export function attachZoom(canvas: HTMLCanvasElement, hand: Hand, zooming: Zooming): void {
  const change = (next: (frame: Frame, zoom: Zoom) => Zoom): void => {
    const frame = zooming.frame();
    if (frame) zooming.setZoom(next(frame, zooming.zoom()));
  };
  const placeOf = (event: MouseEvent): Vec2 => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };

  canvas.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
      change((frame, zoom) =>
        zoomAt(frame, zoom, placeOf(event), WHEEL ** (-event.deltaY * lines)),
      );
    },
    { passive: false },
  );
  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === 'Home') zooming.setZoom(WHOLE);
    else if (event.key === '+' || event.key === '-') {
      const by = event.key === '+' ? KEY : 1 / KEY;
      change((frame, zoom) => zoomAt(frame, zoom, [frame.width / 2, frame.height / 2], by));
    } else return;
    event.preventDefault();
  });

  /** The pressed pointers, and where they are. */
  const pointers = new Map<number, Vec2>();
  let moved_px = 0;
  canvas.addEventListener('pointerdown', (event) => {
    pointers.set(event.pointerId, placeOf(event));
    moved_px = 0;
    // Two fingers zoom, so the first one was neither a tap nor a drag.
    if (pointers.size === 2) hand.release('second finger');
  });
  canvas.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    if (!before || event.buttons === 0) return;
    const now = placeOf(event);
    pointers.set(event.pointerId, now);
    const [other] = [...pointers].filter(([id]) => id !== event.pointerId);
    if (other) {
      const at = other[1];
      const by = distance(now, at) / Math.max(1, distance(before, at));
      change((frame, zoom) => zoomAt(frame, zoom, at, by));
      return;
    }
    moved_px += distance(before, now);
    const isHeld = hand.drag().kind !== 'idle';
    if (isHeld || moved_px < SLOP_PX) return;
    change((frame, zoom) => panBy(frame, zoom, [now[0] - before[0], now[1] - before[1]]));
  });
  const forget = (event: PointerEvent): void => {
    pointers.delete(event.pointerId);
  };
  canvas.addEventListener('pointerup', forget);
  canvas.addEventListener('pointercancel', forget);
}

// Wheel, two fingers, drag and keys zoom and move the plan view.

import { onCleanup } from 'solid-js';
import type { Vec2 } from '../lab/geometry';
import type { Shortcut } from '../ui/shortcuts';
import type { Hand } from './hand';
import { Pressed } from './pressed';
import { type Frame, WHOLE, type Zoom, panBy, zoomAt } from './zoom';

/** Shown in the help. */
export const ZOOM_SHORTCUTS: readonly Shortcut[] = [
  {
    group: 'Workspace',
    keys: ['+', '-'],
    does: 'zoom the plan, like the wheel (with Ctrl in a small window)',
  },
  { group: 'Workspace', keys: ['Home'], does: 'show the whole plan' },
];

/** Zoom per pixel of the wheel. */
const WHEEL = 1.0015;
const KEY = 1.25;

export interface Zooming {
  readonly frame: () => Frame | undefined;
  readonly zoom: () => Zoom;
  readonly setZoom: (zoom: Zoom) => void;
}

/** Whether the page itself is zoomed by two fingers. Rounding may leave a scale just above 1. */
const isPageZoomed = (): boolean => (window.visualViewport?.scale ?? 1) > 1.01;

/** Whether the page scrolls in this layout, so that a plain wheel belongs to it. See plan.css. */
const doesPageScroll = (canvas: Element): boolean =>
  getComputedStyle(canvas).getPropertyValue('--page-scrolls') !== '';

/** Listens while the canvas exists, after the listeners of the hand. */
export function attachZoom(canvas: HTMLCanvasElement, hand: Hand, zooming: Zooming): void {
  /** Returns whether it changed something. */
  const change = (next: (frame: Frame, zoom: Zoom) => Zoom): boolean => {
    const frame = zooming.frame();
    if (!frame) return false;
    const before = zooming.zoom();
    const now = next(frame, before);
    zooming.setZoom(now);
    return now.factor !== before.factor;
  };
  const placeOf = (event: MouseEvent): Vec2 => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };

  canvas.addEventListener(
    'wheel',
    (event) => {
      if (!event.ctrlKey && doesPageScroll(canvas)) return;
      const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
      const isZoomed = change((frame, zoom) =>
        zoomAt(frame, zoom, placeOf(event), WHEEL ** (-event.deltaY * lines)),
      );
      // Otherwise it scrolls the page. With Ctrl it would zoom the page, which is wanted only to get back.
      if (isZoomed || (event.ctrlKey && !isPageZoomed())) event.preventDefault();
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

  const pressed = new Pressed();
  canvas.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    // Its release is noticed outside, too.
    canvas.setPointerCapture(event.pointerId);
    // Two fingers zoom, so the first one was neither a tap nor a drag.
    if (pressed.press(event.pointerId, placeOf(event))) hand.release('second finger');
  });
  canvas.addEventListener('pointermove', (event) => {
    if (event.buttons === 0) {
      pressed.forget(event.pointerId);
      return;
    }
    const gesture = pressed.move(event.pointerId, placeOf(event));
    if (gesture?.type === 'zoom') {
      change((frame, zoom) => zoomAt(frame, zoom, gesture.at, gesture.by));
    } else if (gesture && hand.drag().kind === 'idle') {
      change((frame, zoom) => panBy(frame, zoom, gesture.by));
    }
  });
  const forget = (event: PointerEvent): void => {
    pressed.forget(event.pointerId);
  };
  canvas.addEventListener('pointerup', forget);
  canvas.addEventListener('pointercancel', forget);
  canvas.addEventListener('lostpointercapture', forget);

  // While the page is zoomed, two fingers zoom the page, so that the user can get back.
  const page = window.visualViewport;
  const yieldToPage = (): void => {
    canvas.style.touchAction = isPageZoomed() ? 'pinch-zoom' : '';
  };
  yieldToPage();
  page?.addEventListener('resize', yieldToPage);
  onCleanup(() => page?.removeEventListener('resize', yieldToPage));
}

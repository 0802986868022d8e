// Zoom and pan of the plan view: by wheel, fingers and keys.

import { onCleanup } from 'solid-js';
import { distance } from '../lab/geometry';
import type { Motion, Surface } from './interaction';
import { type Frame, WHOLE, type Zoom, panBy, zoomAt } from './zoom';

/** Zoom per pixel of the wheel. */
const WHEEL = 1.0015;
const KEY = 1.25;

/** Whether the page itself is zoomed by two fingers. Rounding may leave a scale just above 1. */
const isPageZoomed = (): boolean => (window.visualViewport?.scale ?? 1) > 1.01;

/** Whether the page scrolls in this layout, so that a plain wheel belongs to it. See plan.css. */
const doesPageScroll = (canvas: Element): boolean =>
  getComputedStyle(canvas).getPropertyValue('--page-scrolls') !== '';

/** Two fingers zoom the page while it is zoomed, so that the user can get back. */
export function yieldToPage(canvas: HTMLCanvasElement): void {
  const page = window.visualViewport;
  const update = (): void => {
    canvas.style.touchAction = isPageZoomed() ? 'pinch-zoom' : '';
  };
  update();
  page?.addEventListener('resize', update);
  onCleanup(() => page?.removeEventListener('resize', update));
}

export function zooming(
  canvas: () => HTMLCanvasElement | undefined,
  frame: () => Frame | undefined,
  zoom: () => Zoom,
  setZoom: (zoom: Zoom) => void,
): Pick<Surface, 'motion' | 'key'> {
  /** Returns whether it changed the factor. */
  const change = (next: (frame: Frame, zoom: Zoom) => Zoom): boolean => {
    const [now, before] = [frame(), zoom()];
    if (now) setZoom(next(now, before));
    return zoom().factor !== before.factor;
  };
  const motion: Motion = {
    move({ from, to }) {
      change((frame, zoom) => panBy(frame, zoom, [to[0] - from[0], to[1] - from[1]]));
    },
    // The place under the other finger stays.
    pinch({ from, to, other }) {
      const by = distance(to, other) / Math.max(1, distance(from, other));
      change((frame, zoom) => zoomAt(frame, zoom, other, by));
    },
    wheel(event, delta_px, at) {
      const onto = canvas();
      if (!event.ctrlKey && onto && doesPageScroll(onto)) return false;
      const isZoomed = change((frame, zoom) => zoomAt(frame, zoom, at, WHEEL ** -delta_px));
      // Otherwise it scrolls the page. With Ctrl it would zoom the page, which is wanted only to get back.
      return isZoomed || (event.ctrlKey && !isPageZoomed());
    },
  };
  const key = (name: string): boolean => {
    if (name === 'Home') setZoom(WHOLE);
    else if (name === '+' || name === '-') {
      const by = name === '+' ? KEY : 1 / KEY;
      change((frame, zoom) => zoomAt(frame, zoom, [frame.width / 2, frame.height / 2], by));
    } else return false;
    return true;
  };
  return { motion: () => motion, key };
}

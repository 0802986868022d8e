// The drawing by mouse, pen and finger: a click, or a drag beyond a slip of the hand.

import type { Mm } from './drawing';
import type { Editor } from './editor';

/** A press that moves less than this is a click. */
const SLOP_PX = { mouse: 4, touch: 10 } as const;

type Px = readonly [number, number];

interface Press {
  /** Other pointers, such as the palm beside a pen, are ignored. */
  readonly id: number;
  readonly from: Px;
  readonly isDrag: boolean;
}

export function attachPointer(svg: SVGSVGElement, editor: Editor): () => void {
  let press: Press | undefined;
  const place = ([x, y]: Px): Mm => {
    const at = new DOMPoint(x, y).matrixTransform(svg.getScreenCTM()?.inverse());
    return [at.x, at.y];
  };
  const pxOf = (event: PointerEvent): Px => [event.clientX, event.clientY];
  const slopPx = (event: PointerEvent): number =>
    event.pointerType === 'mouse' ? SLOP_PX.mouse : SLOP_PX.touch;
  const slopMm = (event: PointerEvent): number => slopPx(event) / (svg.getScreenCTM()?.a ?? 1);
  const drag = (at: Px, event: PointerEvent): void => {
    editor.act({ type: 'drag', at: place(at), slop_mm: slopMm(event) });
  };

  const onDown = (event: PointerEvent): void => {
    if (press || !event.isPrimary || event.button !== 0) return;
    svg.setPointerCapture(event.pointerId);
    press = { id: event.pointerId, from: pxOf(event), isDrag: false };
    editor.point(place(press.from));
  };
  const onMove = (event: PointerEvent): void => {
    if (press ? press.id !== event.pointerId : !event.isPrimary) return;
    const now = pxOf(event);
    editor.point(place(now));
    if (!press) return;
    if (!press.isDrag) {
      const { id, from } = press;
      if (Math.hypot(now[0] - from[0], now[1] - from[1]) <= slopPx(event)) return;
      press = { id, from, isDrag: true };
      drag(from, event);
    }
    // There was nothing to drag, or a key has cancelled it: nothing happens until the next press.
    if (editor.editing().trace.length > 0) drag(now, event);
  };
  const onUp = (event: PointerEvent): void => {
    if (press?.id !== event.pointerId) return;
    if (press.isDrag) editor.act({ type: 'drop' });
    else editor.act({ type: 'click', at: place(press.from), slop_mm: slopMm(event) });
    press = undefined;
    // A finger that is lifted points nowhere.
    if (event.pointerType === 'touch') editor.point(undefined);
  };
  const onCancel = (event: PointerEvent): void => {
    if (press?.id !== event.pointerId) return;
    if (press.isDrag) editor.act({ type: 'cancel' });
    press = undefined;
  };
  const onLeave = (): void => {
    if (!press) editor.point(undefined);
  };
  const listeners = [
    ['pointerdown', onDown],
    ['pointermove', onMove],
    ['pointerup', onUp],
    ['pointercancel', onCancel],
    ['pointerleave', onLeave],
  ] as const;
  for (const [name, listener] of listeners) svg.addEventListener(name, listener);
  return () => {
    for (const [name, listener] of listeners) svg.removeEventListener(name, listener);
    // The view is left in the middle of a drag.
    if (press?.isDrag) editor.act({ type: 'cancel' });
  };
}

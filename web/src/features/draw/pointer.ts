// The drawing by mouse, pen and finger: a click, or a drag beyond a slip of the hand.

import type { Mm } from './drawing';
import type { Editor } from './editor';

/** A press that moves less than this is a click. */
const SLOP_PX = { mouse: 4, touch: 10 } as const;

type Px = readonly [number, number];

export function attachPointer(svg: SVGSVGElement, editor: Editor): () => void {
  let from: Px | undefined;
  let isDrag = false;
  const place = ([x, y]: Px): Mm => {
    const at = new DOMPoint(x, y).matrixTransform(svg.getScreenCTM()?.inverse());
    return [at.x, at.y];
  };
  const pxOf = (event: PointerEvent): Px => [event.clientX, event.clientY];
  const slopPx = (event: PointerEvent): number =>
    event.pointerType === 'mouse' ? SLOP_PX.mouse : SLOP_PX.touch;
  const slopMm = (event: PointerEvent): number => slopPx(event) / (svg.getScreenCTM()?.a ?? 1);

  const onDown = (event: PointerEvent): void => {
    if (!event.isPrimary || event.button !== 0) return;
    svg.setPointerCapture(event.pointerId);
    [from, isDrag] = [pxOf(event), false];
    editor.point(place(from));
  };
  const onMove = (event: PointerEvent): void => {
    if (!event.isPrimary) return;
    const now = pxOf(event);
    editor.point(place(now));
    if (!from) return;
    if (!isDrag) {
      if (Math.hypot(now[0] - from[0], now[1] - from[1]) <= slopPx(event)) return;
      isDrag = true;
      editor.act({ type: 'drag', at: place(from), slop_mm: slopMm(event) });
    }
    editor.act({ type: 'drag', at: place(now), slop_mm: slopMm(event) });
  };
  const onUp = (event: PointerEvent): void => {
    if (!event.isPrimary || !from) return;
    if (isDrag) editor.act({ type: 'drop' });
    else editor.act({ type: 'click', at: place(from), slop_mm: slopMm(event) });
    from = undefined;
    // A finger that is lifted points nowhere.
    if (event.pointerType === 'touch') editor.point(undefined);
  };
  const onCancel = (event: PointerEvent): void => {
    if (!event.isPrimary || !from) return;
    from = undefined;
    if (isDrag) editor.act({ type: 'cancel' });
  };
  const onLeave = (): void => {
    if (!from) editor.point(undefined);
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
  };
}

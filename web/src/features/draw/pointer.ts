// The drawing by mouse, pen and finger: a click, or a drag beyond a slip of the hand.

import { onCleanup } from 'solid-js';
import { distance, type Vec2 as Px } from '../../lab/geometry';
import type { Mm } from './drawing';
import type { Editor } from './editor';

/** A press that moves less than this is a click. */
const SLOP_PX = { mouse: 4, touch: 10 } as const;

interface Press {
  /** Other pointers, such as the palm beside a pen, are ignored. */
  readonly id: number;
  readonly from: Px;
  readonly isDrag: boolean;
}

type Moved = PointerEvent & { readonly currentTarget: SVGSVGElement };

/** Listeners of the drawing. */
export function createPointer(editor: Editor) {
  let press: Press | undefined;
  const place = ({ currentTarget }: Moved, [x, y]: Px): Mm => {
    const at = new DOMPoint(x, y).matrixTransform(currentTarget.getScreenCTM()?.inverse());
    return [at.x, at.y];
  };
  const pxOf = (event: Moved): Px => [event.clientX, event.clientY];
  const slopPx = (event: Moved): number =>
    event.pointerType === 'mouse' ? SLOP_PX.mouse : SLOP_PX.touch;
  const slopMm = (event: Moved): number =>
    slopPx(event) / (event.currentTarget.getScreenCTM()?.a ?? 1);
  const drag = (at: Px, event: Moved): void =>
    editor.act({ type: 'drag', at: place(event, at), slop_mm: slopMm(event) });
  // The view is left in the middle of a drag.
  onCleanup(() => {
    if (press?.isDrag) editor.act({ type: 'cancel' });
  });
  return {
    onPointerDown: (event: Moved): void => {
      if (press || !event.isPrimary || event.button !== 0) return;
      event.currentTarget.setPointerCapture(event.pointerId);
      press = { id: event.pointerId, from: pxOf(event), isDrag: false };
      editor.point(place(event, press.from));
    },
    onPointerMove: (event: Moved): void => {
      if (press ? press.id !== event.pointerId : !event.isPrimary) return;
      const now = pxOf(event);
      editor.point(place(event, now));
      if (!press) return;
      if (!press.isDrag) {
        const { id, from } = press;
        if (distance(now, from) <= slopPx(event)) return;
        press = { id, from, isDrag: true };
        drag(from, event);
      }
      // There was nothing to drag, or a key has cancelled it: nothing happens until the next press.
      if (editor.editing().trace.length > 0) drag(now, event);
    },
    onPointerUp: (event: Moved): void => {
      if (press?.id !== event.pointerId) return;
      if (press.isDrag) editor.act({ type: 'drop' });
      else editor.act({ type: 'click', at: place(event, press.from), slop_mm: slopMm(event) });
      press = undefined;
      // A finger that is lifted points nowhere.
      if (event.pointerType === 'touch') editor.point(undefined);
    },
    onPointerCancel: (event: Moved): void => {
      if (press?.id !== event.pointerId) return;
      if (press.isDrag) editor.act({ type: 'cancel' });
      press = undefined;
    },
    onPointerLeave: (): void => {
      if (!press) editor.point(undefined);
    },
  };
}

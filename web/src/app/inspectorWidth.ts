// The width of the inspector, which its left edge changes. A double click restores that of the design.

import { recall, remember } from '../ui/storage';

const LEAST_PX = 300;
const KEY = 'inspector.width';

function apply(width_px: number | undefined): void {
  const { style } = document.documentElement;
  if (width_px === undefined) style.removeProperty('--inspector-own');
  else style.setProperty('--inspector-own', `${Math.max(LEAST_PX, Math.round(width_px))}px`);
}

/** Handlers of the edge of `inspector`. The map never becomes smaller: the style sheet limits the width to the free space. */
export function inspectorWidth(inspector: () => HTMLElement) {
  const stored = Number(recall(KEY) ?? Number.NaN);
  if (Number.isFinite(stored) && stored > 0) apply(stored);
  return {
    onPointerDown: (event: PointerEvent & { currentTarget: HTMLElement }): void => {
      event.preventDefault();
      event.currentTarget.setPointerCapture(event.pointerId);
    },
    onPointerMove: (event: PointerEvent & { currentTarget: HTMLElement }): void => {
      if (!event.currentTarget.hasPointerCapture(event.pointerId)) return;
      apply(inspector().getBoundingClientRect().right - event.clientX);
    },
    onPointerUp: (): void => {
      remember(KEY, String(Math.round(inspector().getBoundingClientRect().width)));
    },
    onDblClick: (): void => {
      apply(undefined);
      remember(KEY, '');
    },
  };
}

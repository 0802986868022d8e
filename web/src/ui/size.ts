// The size of an element.

import { onCleanup } from 'solid-js';

/** In CSS pixels. */
export interface Size {
  readonly width: number;
  readonly height: number;
}

/** Calls `take` with the size of the element now and when it changes. */
export function onSize(element: Element, take: (size: Size) => void): void {
  const observer = new ResizeObserver(() =>
    take({ width: element.clientWidth, height: element.clientHeight }),
  );
  observer.observe(element);
  onCleanup(() => observer.disconnect());
}

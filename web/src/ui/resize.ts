// The size of an element.

import { onCleanup } from 'solid-js';

/** Calls `act` at first and at each change of the size, until the owner is disposed of. */
export function onResize(element: Element, act: () => void): void {
  const observer = new ResizeObserver(act);
  observer.observe(element);
  onCleanup(() => {
    observer.disconnect();
  });
}

import { onCleanup } from 'solid-js';

/** What arrives at the window, also from the document. */
type PageEvents = WindowEventMap & Pick<DocumentEventMap, 'visibilitychange'>;

/** Listens until the owner is disposed of. */
export function listen<K extends keyof PageEvents>(
  type: K,
  listener: (event: PageEvents[K]) => void,
  options?: AddEventListenerOptions,
): void {
  const heard = listener as EventListener;
  window.addEventListener(type, heard, options);
  onCleanup(() => window.removeEventListener(type, heard, options));
}

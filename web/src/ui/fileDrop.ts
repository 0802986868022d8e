// Files that are dropped anywhere on the page.

import { onCleanup } from 'solid-js';

/** Takes dropped files whose name fits. The browser never opens a dropped file in place of the page. */
export function onFileDrop(name: RegExp, take: (file: File) => void): void {
  const onOver = (event: DragEvent): void => {
    if (event.dataTransfer?.types.includes('Files')) event.preventDefault();
  };
  const onDrop = (event: DragEvent): void => {
    onOver(event);
    const file = [...(event.dataTransfer?.files ?? [])].find((one) => name.test(one.name));
    if (file) take(file);
  };
  window.addEventListener('dragover', onOver);
  window.addEventListener('drop', onDrop);
  onCleanup(() => {
    window.removeEventListener('dragover', onOver);
    window.removeEventListener('drop', onDrop);
  });
}

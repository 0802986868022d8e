// Files that are dropped anywhere on the page.

import { listen } from './listen';

/** Takes dropped files whose name fits. The browser never opens a dropped file in place of the page. */
export function onFileDrop(name: RegExp, take: (file: File) => void): void {
  const onOver = (event: DragEvent): void => {
    if (event.dataTransfer?.types.includes('Files')) event.preventDefault();
  };
  listen('dragover', onOver);
  listen('drop', (event) => {
    onOver(event);
    const file = [...(event.dataTransfer?.files ?? [])].find((one) => name.test(one.name));
    if (file) take(file);
  });
}

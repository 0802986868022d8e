// The newest camera picture, decoded.

import { createEffect, createSignal, onCleanup, type Accessor } from 'solid-js';
import type { Notices, Pictures } from './slices';

export function createCameraBitmap(
  lab: Notices & Pick<Pictures, 'camera'>,
): Accessor<ImageBitmap | undefined> {
  // The same bitmap object may not be shown twice: it is closed when the next one comes.
  const [bitmap, setBitmap] = createSignal<ImageBitmap>();
  let decoding = false;
  let isGone = false;
  async function decode(bytes: Uint8Array<ArrayBuffer>): Promise<void> {
    decoding = true;
    try {
      const next = await createImageBitmap(new Blob([bytes], { type: 'image/jpeg' }));
      if (isGone) {
        next.close();
        return;
      }
      setBitmap((before) => {
        // After the effects that draw it.
        queueMicrotask(() => before?.close());
        return next;
      });
    } catch {
      lab.notify('session', 'A camera image could not be decoded.');
    }
    decoding = false;
    const newest = lab.camera();
    if (newest && newest.bytes !== bytes) void decode(newest.bytes);
  }
  createEffect(() => {
    const picture = lab.camera();
    // While an image is decoded, the signal keeps only the newest one.
    if (picture && !decoding) void decode(picture.bytes);
  });
  onCleanup(() => {
    isGone = true;
    bitmap()?.close();
  });
  return bitmap;
}

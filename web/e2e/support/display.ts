// A display that is slower, and pictures that are encoded at once.

import type { Page } from '@playwright/test';

/** Runs in the page before its scripts. */
function slowDown(frame_ms: number) {
  const request = window.requestAnimationFrame.bind(window);
  const cancel = window.cancelAnimationFrame.bind(window);
  const cancels = new Map<number, () => void>();
  let last_ms = 0;
  let requests = 0;

  window.requestAnimationFrame = (work) => {
    requests += 1;
    const id = requests;
    const wait_ms = Math.max(0, last_ms + frame_ms - performance.now());
    const timer = setTimeout(() => {
      const frame = request((now) => {
        cancels.delete(id);
        last_ms = now;
        work(now);
      });
      cancels.set(id, () => {
        cancel(frame);
      });
    }, wait_ms);
    cancels.set(id, () => {
      clearTimeout(timer);
    });
    return id;
  };
  window.cancelAnimationFrame = (id) => {
    cancels.get(id)?.();
    cancels.delete(id);
  };
}

/** Runs in the page before its scripts. Chromium encodes a picture when the page is idle: seconds later on a busy machine. */
function encodeAtOnce() {
  HTMLCanvasElement.prototype.toBlob = function (done) {
    const [, text = ''] = this.toDataURL().split(',');
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    queueMicrotask(() => {
      done(new Blob([bytes], { type: 'image/png' }));
    });
  };
}

export const useFastPictures = (page: Page) => page.addInitScript(encodeAtOnce);

/** Makes a page draw less often: without a graphics card, drawing is most of the work. */
export const useSlowDisplay = (page: Page, frame_ms: number) =>
  page.addInitScript(slowDown, frame_ms);

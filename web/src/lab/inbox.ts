// Collects what the server sends until the next animation frame.

import type { Input } from './model';

const HIDDEN_FLUSH_MS = 250;

/** Calls `work` before the next frame, or soon if the page is hidden and draws no frames. */
export function frameScheduler(work: () => void): () => void {
  let cancel: (() => void) | undefined;
  const run = (): void => {
    cancel = undefined;
    work();
  };
  document.addEventListener('visibilitychange', () => {
    if (!cancel) return;
    cancel();
    run();
  });
  return () => {
    if (cancel) return;
    if (document.hidden) {
      const id = setTimeout(run, HIDDEN_FLUSH_MS);
      cancel = () => {
        clearTimeout(id);
      };
    } else {
      const id = requestAnimationFrame(run);
      cancel = () => {
        cancelAnimationFrame(id);
      };
    }
  };
}

/** Drops what `input` supersedes: only the newest state, overlay and obstacle map are drawn. */
export function enqueue(queue: Input[], input: Input): void {
  if (input.type === 'message') {
    const kind = input.message.type;
    if (kind === 'state' || kind === 'overlay' || kind === 'seen') {
      const old = queue.findIndex((item) => item.type === 'message' && item.message.type === kind);
      if (old >= 0) queue.splice(old, 1);
    }
  }
  queue.push(input);
}

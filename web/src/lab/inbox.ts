// Collects what the server sends until the next animation frame.

import type { Input } from './model';

const HIDDEN_FLUSH_MS = 250;
/** States that wait to be drawn. Two of them often arrive within one frame, and none within the next. */
const STATES_MOST = 2;

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
      cancel = () => clearTimeout(id);
    } else {
      const id = requestAnimationFrame(run);
      cancel = () => cancelAnimationFrame(id);
    }
  };
}

const kindOf = (input: Input): string | undefined =>
  input.type === 'message' ? input.message.type : undefined;

const passedOver = (input: Input): Input[] =>
  input.type === 'message' && input.message.type === 'state'
    ? [{ type: 'passed', state: input.message }]
    : [];

/** Inputs that wait for a frame. */
export class Inbox {
  private queue: Input[] = [];

  /** Drops what `input` supersedes: an older overlay or obstacle map. The oldest of too many states is passed over. */
  add(input: Input): void {
    const kind = kindOf(input);
    const most =
      kind === 'state' ? STATES_MOST : kind === 'overlay' || kind === 'seen' ? 1 : Infinity;
    const same = this.queue.filter((item) => kindOf(item) === kind);
    const [oldest] = same;
    if (oldest && same.length >= most) {
      this.queue.splice(this.queue.indexOf(oldest), 1, ...passedOver(oldest));
    }
    this.queue.push(input);
  }

  /** The inputs for one frame, oldest first: those before the second state. */
  take(): Input[] {
    const states = this.queue.flatMap((item, index) => (kindOf(item) === 'state' ? [index] : []));
    return this.queue.splice(0, states[1] ?? this.queue.length);
  }

  get isEmpty(): boolean {
    return this.queue.length === 0;
  }
}

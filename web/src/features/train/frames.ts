// Value maps of a training, read one by one and kept: they never change.

import type { TrainingFrame } from '../../net/protocol.gen';
import { messageOf } from '../../ui/attempt';

/** More at a time would delay the one that is shown. */
const MOST_REQUESTS = 2;
/** After a failed request. */
const PAUSE_MS = 2000;
/** Distance of the first value maps of a fan; then those between. */
const FIRST_STRIDE = 16;

/** The order in which to read `count` value maps: coarse first, so that a fan over time has its shape early. */
export function coarseToFine(count: number): number[] {
  const order = new Set<number>();
  if (count > 0) order.add(count - 1);
  for (let stride = FIRST_STRIDE; stride >= 1; stride /= 2) {
    for (let index = 0; index < count; index += stride) order.add(index);
  }
  return [...order];
}

export class FrameCache {
  private readonly frames = new Map<number, TrainingFrame>();
  private queue: number[] = [];
  private readonly pending = new Set<number>();
  private isClosed = false;

  constructor(
    private readonly load: (index: number) => Promise<TrainingFrame>,
    private readonly listener: {
      /** What is there, or what can be wanted, has changed. */
      readonly changed: () => void;
      /** Why the last request failed; undefined if it did not. */
      readonly failed: (why: string | undefined) => void;
    },
    private readonly pause: () => Promise<void> = () =>
      new Promise((done) => setTimeout(done, PAUSE_MS)),
  ) {}

  get(index: number): TrainingFrame | undefined {
    return this.frames.get(index);
  }

  /** Those that are there, in their order. */
  all(): TrainingFrame[] {
    return [...this.frames].sort(([a], [b]) => a - b).map(([, frame]) => frame);
  }

  /** Reads the value map before all others. */
  want(index: number): void {
    if (this.frames.has(index) || this.pending.has(index)) return;
    this.queue = [index, ...this.queue.filter((one) => one !== index)];
    this.next();
  }

  /** Reads the first `count` value maps, one after the other. */
  wantAll(count: number): void {
    const isKnown = new Set([...this.frames.keys(), ...this.pending, ...this.queue]);
    this.queue.push(...coarseToFine(count).filter((index) => !isKnown.has(index)));
    this.next();
  }

  close(): void {
    this.isClosed = true;
    this.queue = [];
  }

  private next(): void {
    while (this.pending.size < MOST_REQUESTS) {
      const index = this.queue.shift();
      if (index === undefined) return;
      this.pending.add(index);
      void this.read(index);
    }
  }

  private async read(index: number): Promise<void> {
    let why: string | undefined;
    try {
      this.frames.set(index, await this.load(index));
    } catch (reason) {
      why = messageOf(reason);
    }
    if (!this.isClosed) this.listener.failed(why);
    // Its place stays taken for a while, so that an unreachable server gets few requests.
    if (why !== undefined) await this.pause();
    this.pending.delete(index);
    if (this.isClosed) return;
    this.listener.changed();
    this.next();
  }
}

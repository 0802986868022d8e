// Frames of a view: one when something has changed, and more only while something moves.

export class Frames {
  private next: number | undefined;
  /** Undefined while nothing moves. */
  private before_ms: number | undefined;

  /** `draw` gets the time since the frame before, 0 for the first one, and returns whether something still moves. */
  constructor(private readonly draw: (elapsed_ms: number) => boolean) {}

  readonly request = (): void => {
    this.next ??= requestAnimationFrame((now_ms) => {
      this.next = undefined;
      const moves = this.draw(this.before_ms === undefined ? 0 : now_ms - this.before_ms);
      this.before_ms = moves ? now_ms : undefined;
      if (moves) this.request();
    });
  };

  stop(): void {
    if (this.next !== undefined) cancelAnimationFrame(this.next);
  }
}

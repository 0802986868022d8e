// Draws the parts of a figure one after the other, one per frame, so that no frame takes too long.

export class Rotation {
  private turn = 0;
  private wanted = false;
  private going = false;
  private stopped = false;

  /** `begin` takes the data for a round of `parts()`. `nextFrame` calls its argument before the next frame. */
  constructor(
    private readonly parts: () => number,
    private readonly begin: () => void,
    private readonly draw: (part: number) => void,
    private readonly nextFrame: (work: () => void) => void,
  ) {}

  /** Call this when there is new data. */
  offer(): void {
    this.wanted = true;
    if (this.going || this.stopped) return;
    this.going = true;
    this.nextFrame(this.frame);
  }

  stop(): void {
    this.stopped = true;
  }

  private readonly frame = (): void => {
    if (this.stopped) return;
    if (this.turn === 0) {
      this.wanted = false;
      this.begin();
    }
    this.draw(this.turn);
    this.turn = this.turn + 1 < this.parts() ? this.turn + 1 : 0;
    this.going = this.turn !== 0 || this.wanted;
    if (this.going) this.nextFrame(this.frame);
  };
}

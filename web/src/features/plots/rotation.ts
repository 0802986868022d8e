// Draws the parts of a figure in turn, one a frame, so that no frame pays for all of them.

export class Rotation {
  private turn = 0;
  private wanted = false;
  private going = false;
  private stopped = false;

  /** `begin` takes what a round of `parts` shows; `nextFrame` calls what it is given before the next frame. */
  constructor(
    private readonly parts: number,
    private readonly begin: () => void,
    private readonly draw: (part: number) => void,
    private readonly nextFrame: (work: () => void) => void,
  ) {}

  /** There is something new to draw. */
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
    this.turn = (this.turn + 1) % this.parts;
    this.going = this.turn !== 0 || this.wanted;
    if (this.going) this.nextFrame(this.frame);
  };
}

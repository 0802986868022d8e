// A button that acts while it is held.

/** The server forgets the button after 0.25 s. */
const REPEAT_MS = 50;

export interface Hold {
  press(): void;
  release(): void;
}

/** Says at once and again and again that the button is held, and once that it is not. */
export function createHold(say: (held: boolean) => void): Hold {
  let timer: ReturnType<typeof setInterval> | undefined;
  return {
    press() {
      if (timer !== undefined) return;
      say(true);
      timer = setInterval(() => {
        say(true);
      }, REPEAT_MS);
    },
    release() {
      if (timer === undefined) return;
      clearInterval(timer);
      timer = undefined;
      say(false);
    },
  };
}

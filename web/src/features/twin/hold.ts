// A button that acts while it is held.

/** The server forgets the button after 0.25 s. */
const REPEAT_MS = 50;

/** The server knows presses apart by their numbers, also those of other pages. */
const newNumber = (): number => crypto.getRandomValues(new Uint32Array(1))[0] ?? 0;

/** Says at once and again and again that the button is held, in a press with this number, and once that it is not. */
export function createHold(say: (press: number | undefined) => void) {
  let timer: ReturnType<typeof setInterval> | undefined;
  return {
    press: (): void => {
      if (timer !== undefined) return;
      const press = newNumber();
      say(press);
      timer = setInterval(() => say(press), REPEAT_MS);
    },
    release: (): void => {
      if (timer === undefined) return;
      clearInterval(timer);
      timer = undefined;
      say(undefined);
    },
  };
}

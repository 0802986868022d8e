// Numbers as text: with a true minus sign, a fixed number of digits, and a unit.

/** A fixed number of digits, so that a changing number does not jump. */
export function fixed(value: number, digits: number): string {
  const text = value.toFixed(digits);
  // toFixed keeps the sign of a number that it rounds to zero.
  return Number(text) === 0 ? text.replace('-', '') : text.replace('-', '\u2212');
}

/** A label of an axis: with a decimal only if the value is not whole, so that 2.5 does not become 3. */
export const axisLabel = (value: number): string => fixed(value, Number.isInteger(value) ? 0 : 1);

/** Distances on the table between magnet, bead and goal, everywhere on the page. */
export function centimetres(value_m: number, digits = 1): string {
  return `${fixed(value_m * 100, digits)} cm`;
}

/** Heights of the magnet, sizes of drawings and passages, errors of the tracker. */
export function millimetres(value_m: number, digits = 0): string {
  return `${fixed(value_m * 1000, digits)} mm`;
}

export const seconds = (time_s: number): string => `${fixed(time_s, 1)} s`;

/** Newtons, or millinewtons below 0.1 N. */
export function newtons(value_n: number): string {
  return Math.abs(value_n) < 0.1 ? `${fixed(value_n * 1000, 1)} mN` : `${fixed(value_n, 2)} N`;
}

/** `1:02.4`, with minutes only from one minute. */
export function clock(time_s: number): string {
  const tenths = Math.round(time_s * 10);
  const minutes = Math.floor(tenths / 600);
  const seconds = (tenths % 600) / 10;
  return minutes === 0
    ? `${seconds.toFixed(1)} s`
    : `${minutes}:${seconds.toFixed(1).padStart(4, '0')}`;
}

/** `1:02`: minutes and whole seconds. */
export function duration(time_s: number): string {
  const whole = Math.round(time_s);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}`;
}

/** Speed factors below 1 as fractions. */
export function speed(factor: number): string {
  return factor < 1 ? `1/${Math.round(1 / factor)}×` : `${factor}×`;
}

/** With a capital letter, as a sentence begins. */
export const capital = (words: string): string => words.charAt(0).toUpperCase() + words.slice(1);

/** A number with a noun: `1 cell`, `4 cells`. */
export function counted(count: number, noun: string): string {
  return `${count} ${noun}${count === 1 ? '' : 's'}`;
}

/** `40 s`, `3 min`, `1 h 20 min`: as coarse as an estimate. */
export function roughly(time_s: number): string {
  if (time_s < 10) return `${Math.max(1, Math.ceil(time_s))} s`;
  if (time_s < 55) return `${Math.ceil(time_s / 5) * 5} s`;
  const minutes = Math.ceil(time_s / 60);
  if (minutes < 60) return `${minutes} min`;
  const rest = minutes % 60;
  return `${Math.floor(minutes / 60)} h${rest === 0 ? '' : ` ${rest} min`}`;
}

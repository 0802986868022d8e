import type { Palette } from '../ui/palette';
// Colours for values between a smallest and a greatest value.

type Rgb = readonly [number, number, number];
/** Colours of the smallest, the middle and the greatest value, as `#rrggbb`. */
export type Ramp = readonly [string, string, string];

export function heatRamp(palette: Palette): Ramp {
  return [palette['heat-low'], palette['heat-middle'], palette['heat-high']];
}

export function rgb(color: string): Rgb {
  const value = Number.parseInt(color.slice(1), 16);
  return [(value >> 16) & 255, (value >> 8) & 255, value & 255];
}

export type Range = readonly [least: number, greatest: number];

export function rangeOf(values: readonly number[]): Range | undefined {
  return values.length > 0 ? [Math.min(...values), Math.max(...values)] : undefined;
}

/** Colour of a value in a range. */
export function colourOf(ramp: Ramp, [least, greatest]: Range, value: number): Rgb {
  return rampColour(ramp, greatest > least ? (value - least) / (greatest - least) : 0);
}

/** Colour of a share of the range, 0 to 1. */
export function rampColour(ramp: Ramp, share: number): Rgb {
  const inside = Math.min(1, Math.max(0, share));
  const [from, to] = inside < 0.5 ? [ramp[0], ramp[1]] : [ramp[1], ramp[2]];
  const along = inside < 0.5 ? 2 * inside : 2 * inside - 1;
  const [a, b] = [rgb(from), rgb(to)];
  const mix = (k: 0 | 1 | 2): number => Math.round(a[k] + along * (b[k] - a[k]));
  return [mix(0), mix(1), mix(2)];
}

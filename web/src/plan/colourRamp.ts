// Colours for values between a smallest and a greatest value.

import type { Palette } from '../ui/palette';

export type Rgb = readonly [number, number, number];
/** Colours from the smallest to the greatest value at equal distances, as `#rrggbb`. */
export type Ramp = readonly string[];

/** The tokens of each ramp. Those of values are viridis. */
export const RAMPS = {
  value: ['value-0', 'value-1', 'value-2', 'value-3', 'value-4'],
  heat: ['singular-low', 'singular-middle', 'singular-high'],
  field: ['field-low', 'field-middle', 'field-high'],
} as const satisfies Record<string, readonly (keyof Palette)[]>;

export const rampOf = (palette: Palette, name: keyof typeof RAMPS): Ramp =>
  RAMPS[name].map((token) => palette[token]);

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
  const at = Math.min(1, Math.max(0, share)) * (ramp.length - 1);
  const low = Math.min(Math.floor(at), ramp.length - 2);
  const [a, b] = [rgb(ramp[low] ?? '#000000'), rgb(ramp[low + 1] ?? '#000000')];
  const mix = (k: 0 | 1 | 2): number => Math.round(a[k] + (at - low) * (b[k] - a[k]));
  return [mix(0), mix(1), mix(2)];
}

/** Relative luminance, 0 to 1, as in WCAG 2. */
export function luminance(colour: Rgb): number {
  const [r, g, b] = colour.map((part) => {
    const share = part / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  }) as [number, number, number];
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

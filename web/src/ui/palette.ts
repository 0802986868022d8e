// Colours of the canvases, read from the style sheet so that each is defined once.

import { theme, type Theme } from './theme';

const NAMES = [
  'floor',
  'floor-grid',
  'wall',
  'wall-deep',
  'wall-lip',
  'wall-rim',
  'wall-shade',
  'case',
  'ink',
  'ink-2',
  'ink-3',
  'surface',
  'line',
  'magnet',
  'north',
  'south',
  'bead',
  'bead-edge',
  'bead-line',
  'magnet-line',
  'goal',
  'danger',
  'm-ink',
  'm-cursor',
  'm-goal',
  'm-danger',
  'sensed',
  'unseen',
  'fog',
  'error-x',
  'error-y',
  'accent',
  'value-0',
  'value-1',
  'value-2',
  'value-3',
  'value-4',
  'singular-low',
  'singular-middle',
  'singular-high',
  'delivered',
  'late',
  'late-stripes',
  'lost',
  'lost-lattice',
  'field-low',
  'field-middle',
  'field-high',
  'rl',
  'errt',
  'attractor',
  'you',
  'm-rl',
  'm-errt',
  'm-attractor',
  'm-you',
  'm-replanner',
  'm-program',
  'm-robot',
  'replanner',
  'program',
  'robot',
  'table',
  'arm',
  'arm-lid',
  'arm-seam',
  'gripper',
] as const;

export type Palette = Record<(typeof NAMES)[number], string>;

function readPalette(): Palette {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(
    NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]),
  ) as Palette;
}

let newest: { readonly theme: Theme; readonly palette: Palette } | undefined;

/** The colours of the present theme; the same object until the theme changes. */
export function palette(): Palette {
  const now = theme();
  if (newest?.theme !== now) newest = { theme: now, palette: readPalette() };
  return newest.palette;
}

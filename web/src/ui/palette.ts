// Colours of the canvases, read from the style sheet so that each is defined once.

import { theme, type Theme } from './theme';

const NAMES = [
  'floor',
  'grid',
  'wall',
  'wall-edge',
  'text',
  'muted',
  'panel',
  'tool',
  'bead',
  'goal',
  'sensed',
  'unseen',
  'fog',
  'hand',
  'focus',
  'error-x',
  'error-y',
  'danger',
  'plan',
  'flow',
  'heat-low',
  'heat-middle',
  'heat-high',
  'field-low',
  'field-middle',
  'field-high',
  'mode-1',
  'rl',
  'errt',
  'attractor',
  'replanner',
  'you',
  'program',
  'robot',
  'table',
  'arm',
  'arm-lid',
  'arm-seam',
  'gripper',
  'pole-north',
  'pole-south',
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

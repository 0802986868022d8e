// Colours of the canvases, read from the style sheet so that each is written once.

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
  'hand',
  'focus',
  'error-x',
  'error-y',
  'danger',
] as const;

export type Palette = Record<(typeof NAMES)[number], string>;

export function readPalette(): Palette {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(
    NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]),
  ) as Palette;
}

export const VIEW_MODES = [
  ['plan', 'Plan'],
  ['scene', '3-D'],
] as const;

export type ViewMode = (typeof VIEW_MODES)[number][0];

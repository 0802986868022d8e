// The views of the page.

export const VIEWS = [
  ['laboratory', 'Laboratory'],
  ['draw', 'Draw'],
  ['train', 'Train'],
  ['recordings', 'Recordings'],
  ['evaluate', 'Evaluate'],
] as const;

export type View = (typeof VIEWS)[number][0];

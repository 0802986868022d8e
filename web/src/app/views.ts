// The page's views: the laboratory, and what fills the page in its place.

export const VIEWS = [
  ['laboratory', 'Laboratory'],
  ['recordings', 'Recordings'],
  ['evaluate', 'Evaluate'],
] as const;

export type View = (typeof VIEWS)[number][0];

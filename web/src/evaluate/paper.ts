// What the paper reports beside our rows. Pure.

import type { Cell } from '../protocol.gen';

export interface PaperRow {
  readonly section: string;
  readonly episodes: number;
  readonly successes: number;
  /** As printed. */
  readonly printed: string;
  readonly tracking_error_mean_m?: number;
  readonly tracking_error_max_x_m?: number;
  readonly tracking_error_max_y_m?: number;
}

const UNDISTURBED: PaperRow = {
  section: '§V-A',
  episodes: 30,
  successes: 30,
  printed: '100\u00a0%',
  tracking_error_mean_m: 0.02,
  tracking_error_max_x_m: 0.08,
  tracking_error_max_y_m: 0.09,
};

const DISTURBED: PaperRow = {
  section: '§V-A',
  episodes: 30,
  successes: 29,
  printed: '96.6\u00a0%',
};

/**
 * The paper's numbers for a cell: RL alone was counted there, in one maze, after which `colon` is drawn. It does
 * not say how many disturbances an episode had; its figure has three.
 */
export function paperRow(cell: Cell): PaperRow | undefined {
  if (cell.controller !== 'rl' || cell.map !== 'colon') return undefined;
  if (cell.disturbances === 0) return UNDISTURBED;
  return cell.disturbances === 3 ? DISTURBED : undefined;
}

/** Wilson's score interval at 95 % for `k` of `n`, as the server computes it. */
export function wilson95(k: number, n: number): [number, number] {
  const z = 1.959963984540054;
  const p = k / n;
  const z2 = z * z;
  const center = (p + z2 / (2 * n)) / (1 + z2 / n);
  const half = (z / (1 + z2 / n)) * Math.sqrt((p * (1 - p)) / n + z2 / (4 * n * n));
  return [Math.max(0, center - half), Math.min(1, center + half)];
}

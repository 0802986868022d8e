// Progress and remaining time of an evaluation. Pure.

import { CONTROLLER_LABELS, controllerLabel, policyName } from '../../lab/parameters';
import type { Cell, ControllerName, EvaluationSummary } from '../../net/protocol.gen';
import { numberField } from './varied';

export function episodesDone(summary: EvaluationSummary): number {
  return summary.cells.reduce((sum, cell) => sum + cell.done, 0);
}

export function episodesInAll(summary: EvaluationSummary): number {
  return summary.cells.length * summary.query.episodes;
}

/** How similar two cells are in what determines their duration. */
function likeness(a: Cell, b: Cell): number {
  return (
    (a.controller === b.controller ? 4 : 0) +
    (a.disturbances === b.disturbances ? 2 : 0) +
    (a.map === b.map ? 1 : 0)
  );
}

/** Seconds per episode of a cell, from the newest of the most similar measured cells; NaN without one. */
export function secondsAnEpisode(cell: Cell, measured: readonly EvaluationSummary[]): number {
  let best = { likeness: -1, episode_s: NaN };
  for (const other of measured.flatMap(({ cells }) => cells)) {
    const alike = likeness(cell, other);
    if (other.done > 0 && alike >= best.likeness)
      best = { likeness: alike, episode_s: other.elapsed_s / other.done };
  }
  return best.episode_s;
}

/** Remaining seconds; NaN if no similar cell was measured and no episode is done. */
export function remaining_s(
  { cells, query }: EvaluationSummary,
  measured: readonly EvaluationSummary[],
): number {
  return cells
    .filter(({ done }) => done < query.episodes)
    .map((cell) => {
      const { done, elapsed_s } = cell;
      const episode_s = done > 0 ? elapsed_s / done : secondsAnEpisode(cell, measured);
      return (query.episodes - done) * episode_s;
    })
    .reduce((sum_s, cell_s) => sum_s + cell_s, 0);
}

/** 3 for `evaluation-3`. */
export const numberOf = (id: string): string => id.replace(/^evaluation-/, '');

const STAGE_WORDS = {
  waiting: 'waits',
  running: 'runs',
  done: 'done',
  cancelled: 'cancelled',
  failed: 'failed',
} as const;

export const stageWords = ({ stage }: EvaluationSummary): string => STAGE_WORDS[stage];

/** `RL, ERRT on posts; 0 and 3 disturbances; 30 per cell, seed 1`. */
export function subject({ query }: EvaluationSummary): string {
  const { maps, rl_policy, program, episodes, seed } = query;
  const label = (name: ControllerName): string =>
    name === 'rl' && rl_policy !== 'auto'
      ? `${CONTROLLER_LABELS.rl} (${policyName(rl_policy)})`
      : controllerLabel({ controller: name, program: name === 'program' ? program : null });
  const disturbances = query.disturbances.join(' and ');
  return [
    `${query.controllers.map(label).join(', ')} on ${maps.join(', ')}`,
    `${disturbances} ${disturbances === '1' ? 'disturbance' : 'disturbances'}`,
    ...query.vary.map(({ name }) => `${numberField(name).label} varied`),
    `${episodes} per cell, seed ${seed}`,
  ].join('; ');
}

/** Announcement for screen readers. It changes at each quarter, each row, and the end. */
export function milestone(summary: EvaluationSummary): string {
  const name = `Evaluation ${numberOf(summary.id)}`;
  const rows = `${summary.rows_done} of ${summary.cells.length} rows`;
  switch (summary.stage) {
    case 'waiting':
      return `${name} is waiting for another evaluation.`;
    case 'running': {
      const quarters = Math.floor((4 * episodesDone(summary)) / episodesInAll(summary));
      return `${name}: ${25 * quarters} % of the episodes, ${rows}.`;
    }
    case 'done':
      return `${name} is done: ${rows}.`;
    case 'cancelled':
      return `${name} was cancelled after ${rows}.`;
    case 'failed':
      return `${name} failed after ${rows}: ${summary.message ?? 'no reason given'}`;
  }
}

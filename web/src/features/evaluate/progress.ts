// Progress and remaining time of an evaluation. Pure.

import { CONTROLLER_LABELS, controllerLabel, policyName } from '../../lab/parameters';
import type { Cell, ControllerName, EvaluationSummary } from '../../net/protocol.gen';
import { numberField } from './varied';

export function isActive({ stage }: EvaluationSummary): boolean {
  return stage === 'running' || stage === 'waiting';
}

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

/** Seconds per episode of a cell, from the newest of the most similar measured cells. */
export function secondsAnEpisode(
  cell: Cell,
  measured: readonly EvaluationSummary[],
): number | undefined {
  let best: { likeness: number; episode_s: number } | undefined;
  for (const summary of measured) {
    for (const other of summary.cells) {
      if (other.done === 0) continue;
      const alike = likeness(cell, other);
      if (best && alike < best.likeness) continue;
      best = { likeness: alike, episode_s: other.elapsed_s / other.done };
    }
  }
  return best?.episode_s;
}

/** Remaining seconds; undefined if no similar cell was measured and no episode is done. */
export function remaining_s(
  summary: EvaluationSummary,
  measured: readonly EvaluationSummary[],
): number | undefined {
  let sum_s = 0;
  for (const cell of summary.cells) {
    const left = summary.query.episodes - cell.done;
    if (left === 0) continue;
    const episode_s = cell.done > 0 ? cell.elapsed_s / cell.done : secondsAnEpisode(cell, measured);
    if (episode_s === undefined) return undefined;
    sum_s += left * episode_s;
  }
  return sum_s;
}

/** 3 for `evaluation-3`. */
export function numberOf(id: string): string {
  return id.replace(/^evaluation-/, '');
}

const STAGE_WORDS = {
  waiting: 'waits',
  running: 'runs',
  done: 'done',
  cancelled: 'cancelled',
  failed: 'failed',
} as const;

export function stageWords(summary: EvaluationSummary): string {
  return STAGE_WORDS[summary.stage];
}

/** `RL, ERRT on posts; 0 and 3 disturbances`. */
export function subject({ query }: EvaluationSummary): string {
  const { rl_policy, program } = query;
  const label = (name: ControllerName): string =>
    name === 'rl' && rl_policy !== 'auto'
      ? `${CONTROLLER_LABELS.rl} (${policyName(rl_policy)})`
      : controllerLabel({ controller: name, program: name === 'program' ? program : null });
  const controllers = query.controllers.map(label).join(', ');
  const disturbances = query.disturbances.join(' and ');
  const noun = disturbances === '1' ? 'disturbance' : 'disturbances';
  const varied = query.vary.map(({ name }) => `; ${numberField(name).label} varied`).join('');
  return `${controllers} on ${query.maps.join(', ')}; ${disturbances} ${noun}${varied}`;
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

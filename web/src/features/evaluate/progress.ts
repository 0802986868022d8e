// Progress of an evaluation. Pure.

import { CONTROLLER_LABELS, controllerLabel, policyName } from '../../lab/parameters';
import { waitWords } from '../../lab/jobs';
import type { ControllerName, EvaluationSummary, JobSummary } from '../../net/protocol.gen';
import { numberField } from './varied';

export function episodesDone(summary: EvaluationSummary): number {
  return summary.cells.reduce((sum, cell) => sum + cell.done, 0);
}

export function episodesInAll(summary: EvaluationSummary): number {
  return summary.cells.length * summary.query.episodes;
}

/** 3 for `evaluation-3`. */
export const numberOf = (id: string): string => id.replace(/^evaluation-/, '');

const STAGE_WORDS = {
  waiting: 'waits',
  running: 'runs',
  paused: 'paused',
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
export function milestone(summary: EvaluationSummary, job?: JobSummary): string {
  const name = `Evaluation ${numberOf(summary.id)}`;
  const rows = `${summary.rows_done} of ${summary.cells.length} rows`;
  switch (summary.stage) {
    case 'waiting':
      return `${name} ${waitWords(job)}.`;
    case 'paused':
      return `${name} is paused after ${rows}.`;
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

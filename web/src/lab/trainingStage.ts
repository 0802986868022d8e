// What a training does and when it ends, as words. Pure.

import { counted, fixed } from '../ui/format';
import { leftWords, waitWords } from './jobs';
import type {
  EvaluationSummary,
  Examination,
  JobSummary,
  RecoverySummary,
  TrainingStage,
  TrainingSummary,
} from '../net/protocol.gen';

/** Whether a job has not ended. */
export function isActive({
  stage,
}: Pick<TrainingSummary | EvaluationSummary | RecoverySummary, 'stage'>): boolean {
  return stage !== 'done' && stage !== 'cancelled' && stage !== 'failed';
}

/** Whether it takes the server's processors now. */
export function isRunning({ stage }: Pick<TrainingSummary, 'stage'>): boolean {
  return stage === 'images' || stage === 'learning' || stage === 'examination';
}

const STAGE_WORDS: Readonly<Record<TrainingStage, string>> = {
  waiting: 'waits',
  images: 'takes images',
  learning: 'learns',
  examination: 'last examination',
  paused: 'paused',
  done: 'done',
  cancelled: 'cancelled',
  failed: 'failed',
};

export const stageWords = ({ stage }: TrainingSummary): string => STAGE_WORDS[stage];

/** What the stage means, one sentence. */
export function stageSentence(summary: TrainingSummary, job: JobSummary | undefined): string {
  switch (summary.stage) {
    case 'waiting': {
      const words = waitWords(job);
      return `${words.charAt(0).toUpperCase()}${words.slice(1)}.`;
    }
    case 'images':
      return 'The camera takes an image above each cell of the map.';
    case 'learning':
      return learningSentence(summary);
    case 'examination':
      return 'The last examination: many starts and goals, without random steps.';
    case 'paused':
      return `Paused after ${counted(summary.updates, 'update')}.`;
    case 'done':
      return summary.examined ? examinedSentence(summary.examined) : 'The policy can be used.';
    case 'cancelled':
      return `Cancelled after ${counted(summary.updates, 'update')}.`;
    case 'failed':
      return summary.message ?? 'It failed for an unknown reason.';
  }
}

function examinedSentence(examined: Examination): string {
  const share = shareWords(examined);
  if (!examined.all_pairs)
    return `${share} episodes with random starts and goals reached the goal.`;
  // 100 % only if it is all of them.
  const percent = Math.floor((100 * examined.reached) / examined.episodes);
  return `It reaches the goal from ${percent} % of all pairs of cells (${share}).`;
}

function learningSentence({ left_s, episodes }: TrainingSummary): string {
  const tried = `${counted(episodes, 'episode')} so far`;
  return left_s === null ? `${tried}.` : `${tried}, ${leftWords(left_s)}.`;
}

/** `learns, 25 %, about 3 min left`; without numbers in the other stages. */
export function progressWords(summary: TrainingSummary): string {
  const { stage, updates, updates_total, left_s } = summary;
  if (stage !== 'learning') return stageWords(summary);
  const share = Math.floor((100 * updates) / Math.max(1, updates_total));
  const left = left_s === null ? [] : [leftWords(left_s)];
  return [stageWords(summary), `${share} %`, ...left].join(', ');
}

/** `95 % interval: 97.7 to 99.2 %`. */
export function intervalWords({ all_pairs, reached_wilson95 }: Examination): string {
  if (all_pairs) return 'on all pairs';
  const [low, high] = reached_wilson95;
  return `95 % interval: ${fixed(100 * low, 1)} to ${fixed(100 * high, 1)} %`;
}

/** `986 of 1000`. */
export const shareWords = ({ reached, episodes }: Examination): string =>
  `${reached} of ${episodes}`;

/** `1500 of 4000 updates`. */
export const updateWords = ({ updates, updates_total }: TrainingSummary): string =>
  `${updates} of ${counted(updates_total, 'update')}`;

/** Announcement for screen readers. It changes at each quarter and each stage. */
export function milestone(summary: TrainingSummary, job: JobSummary | undefined): string {
  const { query, stage, updates, updates_total } = summary;
  if (stage !== 'learning') return `${query.name}: ${stageSentence(summary, job)}`;
  const quarters = Math.floor((4 * updates) / Math.max(1, updates_total));
  return `${query.name}: ${25 * quarters} % of the updates.`;
}

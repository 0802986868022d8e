// A job as words. Pure.

import { leftWords, waitWords } from '../../lab/jobs';
import { isActive } from '../../lab/trainingStage';
import type { JobKind, JobSummary } from '../../net/protocol.gen';

export const KIND_WORDS: Readonly<Record<JobKind, string>> = {
  evaluation: 'Evaluation',
  recovery: 'Recovery map',
  training: 'Training',
  comparison: 'Comparison',
};

/** `session main`, as seen from a session. */
export function ownerWords({ owner }: JobSummary, session: string): string {
  if (owner === null) return 'from the API';
  return owner === session ? 'of this session' : `of session ${owner}`;
}

const percent = (share: number): string => `${Math.floor(100 * share)} %`;

/** `40 %, about 20 s left`. */
export function stageWords(job: JobSummary): string {
  const { stage, share, left_s, message } = job;
  switch (stage) {
    case 'waiting':
      return waitWords(job);
    case 'running':
      return [percent(share), ...(left_s === null ? [] : [leftWords(left_s)])].join(', ');
    case 'paused':
      return `paused at ${percent(share)}`;
    case 'done':
      return 'done';
    case 'cancelled':
      return `cancelled at ${percent(share)}`;
    case 'failed':
      return `failed: ${message ?? 'no reason given'}`;
  }
}

/** `Training my-posts`. */
export const nameOf = ({ kind, name }: JobSummary): string => `${KIND_WORDS[kind]} ${name}`;

interface Group {
  readonly title: string;
  readonly jobs: readonly JobSummary[];
}

/** The jobs that have not ended by lane, then the others, the last one first. */
export function groupsOf(jobs: readonly JobSummary[]): readonly Group[] {
  const active = jobs.filter(isActive);
  const groups = [
    { title: 'Short jobs', jobs: active.filter(({ lane }) => lane === 'short') },
    { title: 'Long jobs', jobs: active.filter(({ lane }) => lane === 'long') },
    { title: 'Ended', jobs: jobs.filter((job) => !isActive(job)).toReversed() },
  ];
  return groups.filter((group) => group.jobs.length > 0);
}

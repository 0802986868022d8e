// The server's jobs in the background: as words, how long they take, and what can be done with them.

import { createEffect, createSignal, untrack } from 'solid-js';
import type { JobKind, JobSummary } from '../net/protocol.gen';
import { post, remove } from '../net/requests';
import { counted, roughly } from '../ui/format';
import type { Catalog } from './catalog';

/** The job of an evaluation, a recovery map or a training; undefined long after its end. */
export const jobOf = (catalog: Catalog, id: string): JobSummary | undefined =>
  catalog.jobs()?.find((job) => job.id === id);

/** Seconds for one unit of a kind of work on the server's machine; NaN for an unknown kind. */
export const paceOf = (catalog: Catalog, work: string): number =>
  catalog.paces()?.find((pace) => pace.work === work)?.each_s ?? NaN;

/** `about 3 min left`. */
export const leftWords = (left_s: number): string => `about ${roughly(left_s)} left`;

/** `waits for 2 jobs before it, about 4 min`. */
export function waitWords(job: JobSummary | undefined): string {
  if (job?.stage !== 'waiting') return 'waits';
  const { before, starts_in_s } = job;
  if (before === 0) return 'begins';
  const time = starts_in_s === null || starts_in_s < 1 ? '' : `, about ${roughly(starts_in_s)}`;
  return `waits for ${counted(before, 'job')} before it${time}`;
}

/** The path of a request that starts a job for a session. */
export const startPath = (path: string, session: string): string =>
  `${path}?session=${encodeURIComponent(session)}`;

const pathOf = (id: string): string => `/api/jobs/${encodeURIComponent(id)}`;

export const pauseJob = (id: string): Promise<unknown> => post(`${pathOf(id)}/pause`);

export const resumeJob = (id: string): Promise<unknown> => post(`${pathOf(id)}/resume`);

export const cancelJob = (id: string): Promise<void> => remove(pathOf(id));

/** The job whose results are to be shown next. */
const [opened, setOpened] = createSignal<JobSummary>();
export { setOpened as openJob };

/** Takes the job that is to be shown, if it is of this kind. */
export function takeOpened(kind: JobKind, take: (id: string) => void): void {
  createEffect(() => {
    const job = opened();
    if (job?.kind !== kind) return;
    setOpened(undefined);
    untrack(() => {
      take(job.id);
    });
  });
}

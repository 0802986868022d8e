import { expect, it } from 'vitest';
import { jobOf } from '../../lab/testingJobs';
import { groupsOf, nameOf, ownerWords, stageWords } from './words';

it('says how far a job is, and what it waits for', () => {
  expect(stageWords(jobOf())).toBe('25 %, about 3 min left');
  const waits = { stage: 'waiting', before: 2, starts_in_s: 230 } as const;
  expect(stageWords(jobOf(waits))).toBe('waits for 2 jobs before it, about 4 min');
  expect(stageWords(jobOf({ ...waits, before: 1, starts_in_s: 0 }))).toBe(
    'waits for 1 job before it',
  );
  expect(stageWords(jobOf({ ...waits, before: 0 }))).toBe('begins');
  expect(stageWords(jobOf({ stage: 'paused' }))).toBe('paused at 25 %');
  expect(stageWords(jobOf({ stage: 'failed', message: 'No GPU.' }))).toBe('failed: No GPU.');
});

it('says who started it', () => {
  expect(ownerWords(jobOf(), 'main')).toBe('of this session');
  expect(ownerWords(jobOf(), 'anna')).toBe('of session main');
  expect(ownerWords(jobOf({ owner: null }), 'main')).toBe('from the API');
  expect(nameOf(jobOf({ kind: 'recovery', name: 'posts' }))).toBe('Recovery map posts');
});

it('groups by lane, and lists the last one that ended first', () => {
  const jobs = [
    jobOf({ id: 'recovery-1', lane: 'short' }),
    jobOf(),
    jobOf({ id: 'evaluation-1', stage: 'done' }),
    jobOf({ id: 'evaluation-2', stage: 'cancelled', lane: 'short' }),
  ];
  const read = groupsOf(jobs).map(({ title, jobs }) => [title, ...jobs.map(({ id }) => id)]);
  expect(read).toEqual([
    ['Short jobs', 'recovery-1'],
    ['Long jobs', 'training-1'],
    ['Ended', 'evaluation-2', 'evaluation-1'],
  ]);
  expect(groupsOf([])).toEqual([]);
});

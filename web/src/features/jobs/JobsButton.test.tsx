import { expect, it } from 'vitest';
import { page } from 'vitest/browser';
import { jobOf } from '../../lab/testingJobs';
import { fakeLab, refusal, show } from '../../lab/testingLab';
import JobsButton from './JobsButton';

const RECOVERY = jobOf({ id: 'recovery-1', kind: 'recovery', name: 'posts', lane: 'short' });
const button = (name: string | RegExp) => page.getByRole('button', { name });

it('lists what runs and waits, pauses, cancels, and shows only what has results', async () => {
  const { lab, server } = fakeLab({
    'POST /api/jobs/recovery-1/pause': () => ({}),
    'DELETE /api/jobs/recovery-1': () => refusal('job "recovery-1" has ended already'),
    'DELETE /api/jobs/training-1': () => ({}),
  });
  show(() => <JobsButton lab={lab} />);
  await expect.poll(() => lab.connection().kind).toBe('live');
  await expect.element(button(/^Jobs/)).not.toBeInTheDocument();

  const waiting = { stage: 'waiting', before: 1, starts_in_s: 50, has_results: false } as const;
  server.lists({
    jobs: [RECOVERY, jobOf(), jobOf({ id: 'training-2', name: 'yours', ...waiting })],
  });
  await button('Jobs: 3 not ended').click();
  const rows = page.getByRole('listitem');
  await expect.element(rows.nth(0)).toHaveTextContent('25 %, about 3 min left · of this session');
  await expect.element(rows.nth(2)).toHaveTextContent('waits for 1 job before it, about 50 s');
  await expect.element(button('Show Training yours')).not.toBeInTheDocument();

  await button('Pause Recovery map posts').click();
  expect(server.requests).toContain('POST /api/jobs/recovery-1/pause');
  await button('Cancel Recovery map posts').click();
  await expect.element(rows.nth(0)).toHaveTextContent('has ended already');
  await button('Cancel Training my-posts').click();
  await button('Yes, cancel Training my-posts').click();
  await expect.element(rows.nth(1)).toHaveTextContent('cancelling…');

  server.lists({ jobs: [{ ...RECOVERY, stage: 'paused', can_pause: false }] });
  await expect.element(button('Resume Recovery map posts')).toBeEnabled();
  server.lists({ jobs: [{ ...RECOVERY, stage: 'done', can_pause: false, left_s: null }] });
  await expect.element(button('Jobs: 0 not ended')).toBeInTheDocument();
  await expect.element(button(/^(Pause|Resume|Cancel)/)).not.toBeInTheDocument();
  await button('Show Recovery map posts').click();
  expect(lab.panel()).toBe('recovery');
  await expect.element(rows).not.toBeInTheDocument();
});

it('shows a comparison only in its session, and lets a viewer change nothing', async () => {
  const { lab, server } = fakeLab();
  show(() => <JobsButton lab={lab} />);
  await expect.poll(() => lab.connection().kind).toBe('live');
  const comparison = { kind: 'comparison', name: 'posts', can_pause: false } as const;
  server.lists({
    jobs: [
      jobOf({ ...comparison, id: 'comparison-1', owner: 'anna' }),
      jobOf({ ...comparison, id: 'comparison-2', name: 'colon' }),
    ],
  });
  server.hello({ role: 'viewer' });
  await button(/^Jobs/).click();
  await expect.element(button('Cancel Comparison colon')).toBeDisabled();
  await expect.element(button('Show Comparison posts')).not.toBeInTheDocument();
  await button('Show Comparison colon').click();
  expect(lab.panel()).toBe('compare');
});

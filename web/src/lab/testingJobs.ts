// A job for the unit tests.

import type { JobSummary } from '../net/protocol.gen';

export function jobOf(change: Partial<JobSummary> = {}): JobSummary {
  return {
    id: 'training-1',
    kind: 'training',
    name: 'my-posts',
    owner: 'main',
    lane: 'long',
    stage: 'running',
    message: null,
    before: 0,
    starts_in_s: null,
    share: 0.25,
    estimate_s: 240,
    left_s: 180,
    can_pause: true,
    has_results: true,
    ...change,
  };
}

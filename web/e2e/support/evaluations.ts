// Evaluations that are started by request.

import { type APIRequestContext, expect } from '@playwright/test';
import type { EvaluationReport } from './wire';

const RUN_MS = 60_000;

/** Starts an evaluation, waits until it is done, and returns its id. */
export async function startEvaluation(
  request: APIRequestContext,
  origin: string,
  query: Omit<EvaluationReport['query'], 'rl_policy' | 'program' | 'vary'>,
) {
  const response = await request.post(`${origin}/api/evaluations`, { data: query });
  expect(response.ok(), await response.text()).toBe(true);
  const { id } = (await response.json()) as EvaluationReport;
  await expect
    .poll(
      async () => {
        const report = await request.get(`${origin}/api/evaluations/${id}`);
        return ((await report.json()) as EvaluationReport).stage;
      },
      { message: id, intervals: [50], timeout: RUN_MS },
    )
    .toBe('done');
  return id;
}

// What can be done with evaluations, and their reports.

import type { Accessor } from 'solid-js';
import { startPath } from '../../lab/jobs';
import { createDetail } from '../../net/detail';
import { post, remove } from '../../net/requests';
import type { EvaluationQuery, EvaluationReport, EvaluationSummary } from '../../net/protocol.gen';

const PATH = '/api/evaluations';

/** Starts an evaluation for a session and returns its id. */
export const startEvaluation = async (session: string, query: EvaluationQuery): Promise<string> =>
  (await post<EvaluationSummary>(startPath(PATH, session), JSON.stringify(query))).id;

export const cancelEvaluation = (id: string): Promise<void> => remove(`${PATH}/${id}`);

/** Rows and failures of an evaluation. Fetched again when their number grows. */
export const createReport = (
  summary: Accessor<EvaluationSummary>,
): Accessor<EvaluationReport | undefined> =>
  createDetail<EvaluationSummary, EvaluationReport>(PATH, summary, ({ id, stage, rows_done }) =>
    [id, stage, rows_done].join(' '),
  );

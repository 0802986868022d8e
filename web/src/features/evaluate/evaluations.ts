// The server's evaluations, polled: often while one runs.

import type { Accessor } from 'solid-js';
import { createDetail } from '../../net/detail';
import { createPoll } from '../../net/poll';
import { post, remove } from '../../net/requests';
import type {
  EvaluationQuery,
  EvaluationReport,
  Evaluations,
  EvaluationSummary,
} from '../../net/protocol.gen';
import { isActive } from './progress';

const BUSY_MS = 500;
/** Another operator may start one. */
const IDLE_MS = 3000;

const PATH = '/api/evaluations';

export interface EvaluationList {
  /** In the order of the requests; undefined before the first answer. */
  readonly all: Accessor<readonly EvaluationSummary[] | undefined>;
  /** Why the list is out of date, if it is. */
  readonly trouble: Accessor<string | undefined>;
  /** Starts an evaluation and returns its id. */
  start(query: EvaluationQuery): Promise<string>;
  cancel(id: string): Promise<void>;
}

export function createEvaluationList(): EvaluationList {
  const poll = createPoll<Evaluations>(PATH, (newest) =>
    newest?.evaluations.some(isActive) ? BUSY_MS : IDLE_MS,
  );
  return {
    all: () => poll.data()?.evaluations,
    trouble: poll.error,
    start: async (query) => {
      const { id } = await post<EvaluationSummary>(PATH, JSON.stringify(query));
      await poll.refresh();
      return id;
    },
    cancel: async (id) => {
      await remove(`${PATH}/${id}`);
      await poll.refresh();
    },
  };
}

/** Rows and failures of an evaluation. Fetched again when their number grows. */
export function createReport(
  summary: Accessor<EvaluationSummary | undefined>,
): Accessor<EvaluationReport | undefined> {
  return createDetail<EvaluationSummary, EvaluationReport>(PATH, summary, version);
}

/** Changes when a report's rows or failures change. */
function version({ id, stage, rows_done }: EvaluationSummary): string {
  return [id, stage, rows_done].join(' ');
}

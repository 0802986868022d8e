// The server's evaluations, polled: often while one runs.

import { createEffect, createSignal, onCleanup, type Accessor } from 'solid-js';
import { askServer } from '../../net/access';
import { problemText } from '../../net/problem';
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

/** The server refused a request. */
export class Refusal extends Error {
  constructor(
    readonly detail: string,
    readonly field?: string,
  ) {
    super(detail);
  }
}

async function ask<A>(method: string, path: string, body?: unknown): Promise<A> {
  const sent =
    body === undefined
      ? {}
      : { headers: { 'content-type': 'application/json' }, body: JSON.stringify(body) };
  const response = await askServer(path, { method, ...sent }).catch(() => {
    throw new Refusal('The server did not answer.');
  });
  const answer: unknown = await response.json().catch(() => undefined);
  if (response.ok) return answer as A;
  const detail = problemText(answer) ?? `The server answered with status ${response.status}.`;
  const field = (answer as { field?: unknown } | undefined)?.field;
  throw typeof field === 'string' ? new Refusal(detail, field) : new Refusal(detail);
}

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
  const [all, setAll] = createSignal<readonly EvaluationSummary[]>();
  const [trouble, setTrouble] = createSignal<string>();
  let timer: ReturnType<typeof setTimeout> | undefined;
  let requests = 0;
  let isClosed = false;

  const look = async (): Promise<void> => {
    clearTimeout(timer);
    if (isClosed) return;
    requests += 1;
    const number = requests;
    try {
      const { evaluations } = await ask<Evaluations>('GET', PATH);
      if (number !== requests) return;
      setAll(evaluations);
      setTrouble(undefined);
    } catch (reason) {
      if (number !== requests) return;
      setTrouble(reason instanceof Error ? reason.message : String(reason));
    }
    timer = setTimeout(() => void look(), all()?.some(isActive) ? BUSY_MS : IDLE_MS);
  };
  void look();
  onCleanup(() => {
    clearTimeout(timer);
    // A pending answer is ignored.
    requests += 1;
    isClosed = true;
  });

  return {
    all,
    trouble,
    start: async (query) => {
      const { id } = await ask<EvaluationSummary>('POST', PATH, query);
      await look();
      return id;
    },
    cancel: async (id) => {
      await ask<EvaluationSummary>('DELETE', `${PATH}/${id}`);
      await look();
    },
  };
}

/** Rows and failures of an evaluation. Fetched again when their number grows. */
export function createReport(
  summary: Accessor<EvaluationSummary | undefined>,
): Accessor<EvaluationReport | undefined> {
  const [report, setReport] = createSignal<EvaluationReport>();
  let pending: string | undefined;
  // Each poll of the list requests the report again if the last answer did not arrive.
  createEffect(() => {
    const now = summary();
    const had = report();
    if (!now) return;
    if (had && version(had) === version(now)) {
      // An answer for an evaluation that was chosen in between is ignored.
      pending = undefined;
      return;
    }
    if (pending === version(now)) return;
    const requested = version(now);
    pending = requested;
    void ask<EvaluationReport>('GET', `${PATH}/${now.id}`)
      .then((answer) => {
        if (pending === requested) setReport(answer);
      })
      // The list shows the reason of a failure.
      .catch(() => undefined)
      .finally(() => {
        if (pending === requested) pending = undefined;
      });
  });
  return () => (report()?.id === summary()?.id ? report() : undefined);
}

/** Changes when a report's rows or failures change. */
function version({ id, stage, rows_done }: EvaluationSummary): string {
  return [id, stage, rows_done].join(' ');
}

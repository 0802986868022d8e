// Queries to the server's calculator, sent again when they change.

import { createEffect, createMemo, createSignal, onCleanup, type Accessor } from 'solid-js';
import { askServer } from './access';
import { browserClock, type Clock, Limiter } from './limiter';
import { problemField, problemText } from './problem';

export interface Answer<A> {
  /** The newest answer. It is kept when a later query is refused. */
  readonly data?: A;
  /** Why the newest query has no answer. */
  readonly error?: string;
  /** The key of the newest query that was answered or refused. */
  readonly key?: string | undefined;
}

const QUERIES_PER_S = 12;

/** Sends the newest query, at a limited rate. An answer that arrives after a later one is dropped. */
export class Asker<A> {
  private readonly limiter: Limiter<readonly [question: string, key?: string]>;
  private sent = 0;
  private answered = 0;
  private newest: Answer<A> = {};

  constructor(
    private readonly answerTo: (question: string) => Promise<A>,
    private readonly report: (answer: Answer<A>) => void,
    perS = QUERIES_PER_S,
    clock: Clock = browserClock,
  ) {
    this.limiter = new Limiter(
      1000 / perS,
      ([question, key]) => void this.send(question, key),
      clock,
    );
  }

  ask(question: string, key?: string): void {
    this.limiter.offer(key === undefined ? [question] : [question, key]);
  }

  /** Stops reporting answers. */
  forget(): void {
    this.answered = this.sent;
  }

  private async send(question: string, key?: string): Promise<void> {
    this.sent += 1;
    const number = this.sent;
    let answer: Answer<A>;
    try {
      answer = { data: await this.answerTo(question), key };
    } catch (reason) {
      answer = { error: reason instanceof Error ? reason.message : String(reason), key };
    }
    if (number <= this.answered) return;
    this.answered = number;
    this.newest = answer.error === undefined ? answer : { ...this.newest, ...answer };
    this.report(this.newest);
  }
}

/** The server refused a request or did not answer. */
export class Refusal extends Error {
  constructor(
    readonly detail: string,
    /** The field of the request that is wrong, if it is one. */
    readonly field?: string,
    /** The HTTP status; undefined without an answer. */
    readonly status?: number,
  ) {
    super(detail);
  }
}

async function answered(path: string, init: RequestInit): Promise<Response> {
  const response = await askServer(path, init).catch(() => {
    throw new Refusal('The server did not answer.');
  });
  if (!response.ok) {
    const { status } = response;
    const problem: unknown = await response.json().catch(() => undefined);
    const detail = problemText(problem) ?? `The server answered with status ${status}.`;
    throw new Refusal(detail, problemField(problem), status);
  }
  return response;
}

async function request<A>(path: string, init: RequestInit): Promise<A> {
  return (await (await answered(path, init)).json()) as A;
}

/** Gets JSON from `path`; throws a refusal with the message to show. */
export function get<A>(path: string): Promise<A> {
  return request(path, {});
}

/** Gets text from `path`; throws a refusal with the message to show. */
export async function getText(path: string): Promise<string> {
  return (await answered(path, {})).text();
}

/** Posts to `path` and returns the answer; throws a refusal with the message to show. */
export function post<A>(path: string, body?: string | Blob, type = 'application/json'): Promise<A> {
  const sent = body === undefined ? {} : { headers: { 'content-type': type }, body };
  return request(path, { method: 'POST', ...sent });
}

/** Changes the resource at `path` and returns it; throws a refusal with the message to show. */
export function patch<A>(path: string, body: string): Promise<A> {
  return request(path, {
    method: 'PATCH',
    headers: { 'content-type': 'application/json' },
    body,
  });
}

/** Deletes the resource at `path`; throws a refusal with the message to show. */
export async function remove(path: string): Promise<void> {
  await answered(path, { method: 'DELETE' });
}

export interface Asking {
  /** What the answer depends on besides the query. When it changes, the same query is sent again. */
  readonly key?: Accessor<string>;
  /** Largest number of queries per second. */
  readonly perS?: number;
}

/** The answer to `question` at `path`. While the query is undefined, the last answer stays. */
export function createAnswer<Q, A>(
  path: string,
  question: Accessor<Q | undefined>,
  { key, perS }: Asking = {},
): Accessor<Answer<A>> {
  const [answer, setAnswer] = createSignal<Answer<A>>({});
  const asker = new Asker<A>((body) => post<A>(path, body), setAnswer, perS);
  // Compared as text, so that an equal query is not sent again.
  const body = createMemo(() => {
    const now = question();
    return now === undefined ? undefined : JSON.stringify(now);
  });
  const keyNow = createMemo(() => key?.());
  createEffect(() => {
    const now = body();
    const key = keyNow();
    if (now === undefined) asker.forget();
    else asker.ask(now, key);
  });
  onCleanup(() => {
    asker.forget();
  });
  return answer;
}

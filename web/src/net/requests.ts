// Queries to the server's calculator, sent again when they change.

import { createEffect, createMemo, createSignal, onCleanup, type Accessor } from 'solid-js';
import { askServer } from './access';
import { Limiter } from './limiter';
import { problemOf, reasonText } from './problem';

export interface Answer<A> {
  /** The newest answer. It is kept when a later query is refused. */
  readonly data?: A;
  /** Why the newest query has no answer. */
  readonly error?: string;
  /** The key of the newest query that was answered or refused. */
  readonly key?: string | undefined;
}

const QUERIES_PER_S = 12;

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

/** The response to a request; throws a refusal with the message to show. */
export async function answered(path: string, init: RequestInit): Promise<Response> {
  const response = await askServer(path, init).catch(() => {
    throw new Refusal('The server did not answer.');
  });
  if (!response.ok) {
    const { status } = response;
    const { detail, field } = await problemOf(response);
    throw new Refusal(detail ?? `The server answered with status ${status}.`, field, status);
  }
  return response;
}

async function request<A>(path: string, init: RequestInit): Promise<A> {
  return (await (await answered(path, init)).json()) as A;
}

/** Gets JSON from `path`; throws a refusal with the message to show. */
export const get = <A>(path: string): Promise<A> => request(path, {});

/** Gets text from `path`; throws a refusal with the message to show. */
export const getText = async (path: string): Promise<string> => (await answered(path, {})).text();

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

/**
 * The answer to the newest question, asked at a limited rate. An answer that arrives after a later one is dropped. While
 * the question is undefined, the last answer stays.
 */
export function createAnswerFrom<A>(
  answerTo: (question: string) => Promise<A>,
  question: Accessor<string | undefined>,
  { key, perS = QUERIES_PER_S }: Asking = {},
): Accessor<Answer<A>> {
  const [answer, setAnswer] = createSignal<Answer<A>>({});
  let sent = 0;
  let answered = 0;
  const send = async (body: string, key: string | undefined): Promise<void> => {
    sent += 1;
    const number = sent;
    let next: Answer<A>;
    try {
      next = { data: await answerTo(body), key };
    } catch (reason) {
      next = { ...answer(), error: reasonText(reason), key };
    }
    if (number <= answered) return;
    answered = number;
    setAnswer(next);
  };
  const limiter = new Limiter<readonly [string, string | undefined]>(
    1000 / perS,
    ([body, key]) => void send(body, key),
  );
  const forget = (): void => {
    answered = sent;
  };
  // Memos, so that an equal question is not sent again.
  const body = createMemo(question);
  const keyNow = createMemo(() => key?.());
  createEffect(() => {
    const [now, key] = [body(), keyNow()];
    if (now === undefined) forget();
    else limiter.offer([now, key]);
  });
  onCleanup(forget);
  return answer;
}

/** The answer to a query at `path`. */
export function createAnswer<Q, A>(
  path: string,
  query: Accessor<Q | undefined>,
  asking?: Asking,
): Accessor<Answer<A>> {
  return createAnswerFrom(
    (body) => post<A>(path, body),
    () => {
      const now = query();
      return now === undefined ? undefined : JSON.stringify(now);
    },
    asking,
  );
}

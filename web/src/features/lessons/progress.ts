// Which lessons are done and what was predicted. Kept in the browser's storage.

import type { Lesson } from './lesson';

export interface Progress {
  readonly done: readonly string[];
  /** Id of the choice, by lesson. */
  readonly choices: Readonly<Record<string, string>>;
}

export const NO_PROGRESS: Progress = { done: [], choices: {} };

type Fields = Readonly<Partial<Record<string, unknown>>>;

function parsed(text: string | null): Fields {
  try {
    return Object(JSON.parse(text ?? 'null')) as Fields;
  } catch {
    // Not written by this page.
    return {};
  }
}

/** The stored progress without lessons and choices that no longer exist. */
export function progressFrom(text: string | null, lessons: readonly Lesson[]): Progress {
  const stored = parsed(text);
  const done: unknown[] = Array.isArray(stored.done) ? stored.done : [];
  const choices = Object(stored.choices) as Fields;
  const isOffered = ({ id, choices: offered }: Lesson): boolean =>
    typeof choices[id] === 'string' && Object.hasOwn(offered, choices[id]);
  return {
    done: lessons.map(({ id }) => id).filter((id) => done.includes(id)),
    choices: Object.fromEntries(
      lessons.filter(isOffered).map(({ id }) => [id, choices[id] as string]),
    ),
  };
}

// Which lessons are done and what was predicted. Kept in the browser's storage.

import { recall, remember } from '../../ui/storage';
import type { Lesson } from './lesson';

export interface Progress {
  readonly done: readonly string[];
  /** Id of the choice, by lesson. */
  readonly choices: Readonly<Record<string, string>>;
}

export const NO_PROGRESS: Progress = { done: [], choices: {} };
const KEY = 'lessons';

function field(value: unknown, name: string): unknown {
  if (typeof value !== 'object' || value === null) return undefined;
  return Object.entries(value).find(([key]) => key === name)?.[1];
}

/** The stored progress without lessons and choices that no longer exist. */
export function progressFrom(text: string | null, lessons: readonly Lesson[]): Progress {
  let stored: unknown;
  try {
    stored = JSON.parse(text ?? 'null');
  } catch {
    // Not written by this page: treat it as empty.
  }
  const done = field(stored, 'done');
  const choices = field(stored, 'choices');
  const kept = lessons.flatMap(({ id, choices: offered }) => {
    const made = offered.find((choice) => choice.id === field(choices, id));
    return made ? [[id, made.id] as const] : [];
  });
  return {
    done: lessons
      .map(({ id }) => id)
      .filter((id) => Array.isArray(done) && done.some((one) => one === id)),
    choices: Object.fromEntries(kept),
  };
}

export function storedProgress(lessons: readonly Lesson[]): Progress {
  return progressFrom(recall(KEY), lessons);
}

export function storeProgress(progress: Progress): void {
  remember(KEY, JSON.stringify(progress));
}

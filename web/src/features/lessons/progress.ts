// Which lessons are done, and what was predicted: kept in the browser. Pure, but for the storage.

import { recall, remember } from '../../ui/storage';
import type { Lesson } from './lesson';

export interface Progress {
  readonly done: readonly string[];
  /** The choice made, by lesson. */
  readonly choices: Readonly<Record<string, string>>;
}

export const NO_PROGRESS: Progress = { done: [], choices: {} };
const KEY = 'lessons';

function field(value: unknown, name: string): unknown {
  if (typeof value !== 'object' || value === null) return undefined;
  return Object.entries(value).find(([key]) => key === name)?.[1];
}

/** What was stored, less what is no lesson or no choice any more. */
export function progressFrom(text: string | null, lessons: readonly Lesson[]): Progress {
  let stored: unknown;
  try {
    stored = JSON.parse(text ?? 'null');
  } catch {
    // Not of this page; as good as nothing.
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

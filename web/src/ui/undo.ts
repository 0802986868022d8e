// The present of something that changes, with its past and undone future. Pure.

export interface Undo<T> {
  readonly past: readonly T[];
  readonly present: T;
  readonly future: readonly T[];
}

/** Older states are forgotten. */
const MOST = 200;

export const startOf = <T>(present: T): Undo<T> => ({ past: [], present, future: [] });

/** Goes on to a new state. The undone ones are dropped. */
export function onward<T>({ past, present }: Undo<T>, next: T): Undo<T> {
  return { past: [...past, present].slice(-MOST), present: next, future: [] };
}

/** Replaces the present: the change before goes on. */
export function amended<T>({ past }: Undo<T>, next: T): Undo<T> {
  return { past, present: next, future: [] };
}

export function undone<T>(undo: Undo<T>): Undo<T> {
  const before = undo.past.at(-1);
  if (before === undefined) return undo;
  return { past: undo.past.slice(0, -1), present: before, future: [undo.present, ...undo.future] };
}

export function redone<T>(undo: Undo<T>): Undo<T> {
  const [next, ...future] = undo.future;
  if (next === undefined) return undo;
  return { past: [...undo.past, undo.present], present: next, future };
}

// The user's choices in the browser's storage. If storage is forbidden or full, choices last as long as the page.

import { createSignal, type Accessor } from 'solid-js';

/** Choices that could not be stored. */
const unstored = new Map<string, string>();

export function recall(key: string): string | null {
  const choice = unstored.get(key);
  if (choice !== undefined) return choice;
  try {
    return localStorage.getItem(`ferry.${key}`);
  } catch {
    return null;
  }
}

export function remember(key: string, value: string): void {
  try {
    localStorage.setItem(`ferry.${key}`, value);
    unstored.delete(key);
  } catch {
    unstored.set(key, value);
  }
}

function forget(key: string): void {
  unstored.delete(key);
  try {
    localStorage.removeItem(`ferry.${key}`);
  } catch {
    // There is no storage to forget from.
  }
}

/** One of some values, as the user chose last; the first one until then. Only the others are stored. */
export function createChoice<const T extends string>(
  key: string,
  values: readonly [T, ...T[]],
): readonly [value: Accessor<T>, choose: (value: T) => void] {
  const stored = recall(key);
  const [value, setValue] = createSignal<T>(values.find((one) => one === stored) ?? values[0]);
  return [
    value,
    (next) => {
      setValue(() => next);
      if (next === values[0]) forget(key);
      else remember(key, next);
    },
  ];
}

/** What this tab remembers over a reload, or nothing if storage is forbidden. */
export function tabStorage(): Pick<Storage, 'getItem' | 'setItem' | 'removeItem'> {
  try {
    return window.sessionStorage;
  } catch {
    return { getItem: () => null, setItem: () => undefined, removeItem: () => undefined };
  }
}

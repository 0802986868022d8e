// The user's choices in the browser's storage. If storage is forbidden or full, choices last as long as the page.

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

/** What this tab remembers over a reload, or nothing if storage is forbidden. */
export function tabStorage(): Pick<Storage, 'getItem' | 'setItem' | 'removeItem'> {
  try {
    return window.sessionStorage;
  } catch {
    return { getItem: () => null, setItem: () => undefined, removeItem: () => undefined };
  }
}

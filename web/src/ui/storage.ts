// The user's choices in the browser's storage. If storage is forbidden, choices last as long as the page.

export function recall(key: string): string | null {
  try {
    return localStorage.getItem(`ferry.${key}`);
  } catch {
    return null;
  }
}

export function remember(key: string, value: string): void {
  try {
    localStorage.setItem(`ferry.${key}`, value);
  } catch {
    // See above.
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

// What this browser remembers of a person's choices. Storage may be forbidden: they then last as long as the page.

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

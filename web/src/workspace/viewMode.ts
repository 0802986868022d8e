// From above or in space: how the workspace is shown, as the person chooses it.

export const VIEW_MODES = [
  ['plan', 'Plan'],
  ['scene', '3-D'],
] as const;

export type ViewMode = (typeof VIEW_MODES)[number][0];

const KEY = 'ferry.view';

/** What was stored, or the plan when that is no mode. */
export function viewModeFrom(text: string | null): ViewMode {
  return VIEW_MODES.find(([mode]) => mode === text)?.[0] ?? 'plan';
}

export function storedViewMode(): ViewMode {
  try {
    return viewModeFrom(localStorage.getItem(KEY));
  } catch {
    // Storage may be forbidden; the choice then lasts as long as the page.
    return 'plan';
  }
}

export function storeViewMode(mode: ViewMode): void {
  try {
    localStorage.setItem(KEY, mode);
  } catch {
    // See `storedViewMode`.
  }
}

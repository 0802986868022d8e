// The user's choice between the plan view and the 3-D view.

import { recall, remember } from '../ui/storage';

export const VIEW_MODES = [
  ['plan', 'Plan'],
  ['scene', '3-D'],
] as const;

export type ViewMode = (typeof VIEW_MODES)[number][0];

const KEY = 'view';

/** The stored mode, or the plan view if the stored text is not a mode. */
export function viewModeFrom(text: string | null): ViewMode {
  return VIEW_MODES.find(([mode]) => mode === text)?.[0] ?? 'plan';
}

export function storedViewMode(): ViewMode {
  return viewModeFrom(recall(KEY));
}

export function storeViewMode(mode: ViewMode): void {
  remember(KEY, mode);
}

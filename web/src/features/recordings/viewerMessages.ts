// Messages from the laboratory to the viewer's page in its frame.

import { addressOf } from '../../net/base';
import type { Theme } from '../../ui/theme';

export interface ThemeMessage {
  readonly type: 'theme';
  readonly theme: Theme;
}

/** Address of the viewer's page, showing a recording. */
export function viewerAddress(recording: string, theme: Theme): string {
  return addressOf(`/viewer/?${new URLSearchParams({ recording, theme }).toString()}`);
}

export function themeOf(message: unknown): Theme | undefined {
  if (typeof message !== 'object' || !message || !('theme' in message)) return undefined;
  return message.theme === 'dark' || message.theme === 'light' ? message.theme : undefined;
}

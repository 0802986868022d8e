// Dark or light: the user's choice, otherwise the system's preference.

import { createSignal, type Accessor } from 'solid-js';
import { recall, remember } from './storage';

export type Theme = 'dark' | 'light';
const KEY = 'theme';

function stored(): Theme | undefined {
  const value = recall(KEY);
  return value === 'dark' || value === 'light' ? value : undefined;
}

export function createTheme(): { theme: Accessor<Theme>; toggle: () => void } {
  const prefersDark = matchMedia('(prefers-color-scheme: dark)');
  let chosen = stored();
  const resolve = (): Theme => chosen ?? (prefersDark.matches ? 'dark' : 'light');
  const [theme, setTheme] = createSignal(resolve());
  // Set before the signal changes, because canvases read their colours from the style sheet.
  const apply = (): void => {
    document.documentElement.dataset.theme = resolve();
    setTheme(resolve());
  };
  apply();
  prefersDark.addEventListener('change', apply);
  return {
    theme,
    toggle: () => {
      chosen = theme() === 'dark' ? 'light' : 'dark';
      remember(KEY, chosen);
      apply();
    },
  };
}

// Dark or light: the user's choice, otherwise the system's preference. One for the page.

import { createSignal } from 'solid-js';
import { recall, remember } from './storage';

export type Theme = 'dark' | 'light';
const KEY = 'theme';

function createTheme() {
  const prefersDark = matchMedia('(prefers-color-scheme: dark)');
  let chosen = recall(KEY);
  const resolve = (): Theme =>
    chosen === 'dark' || chosen === 'light' ? chosen : prefersDark.matches ? 'dark' : 'light';
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

let shared: ReturnType<typeof createTheme> | undefined;
/** The first call sets the theme of the document. */
export const theme = (): Theme => (shared ??= createTheme()).theme();
export const toggleTheme = (): void => (shared ??= createTheme()).toggle();

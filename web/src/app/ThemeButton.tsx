// Changes between light and dark colours.

import type { JSX } from 'solid-js';
import { Moon, Sun } from 'lucide';
import { Icon } from '../ui/Icon';
import { theme, toggleTheme } from '../ui/theme';

export function ThemeButton(): JSX.Element {
  return (
    <button type="button" onClick={toggleTheme}>
      <Icon of={theme() === 'dark' ? Sun : Moon} />
      {theme() === 'dark' ? 'Light' : 'Dark'}
    </button>
  );
}

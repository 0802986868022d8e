// The viewer follows the system's colour scheme: version 0.36 loses its option `theme` at the first start. So its media
// query gets the laboratory's theme as the answer.

import type { Theme } from '../../ui/theme';

const QUERY = /^\(prefers-color-scheme: (dark|light)\)$/;

/** The system's preference, replaced by a theme. */
export class Scheme {
  private readonly lists: MediaQueryList[] = [];

  constructor(private theme: Theme) {}

  /** A `matchMedia` that answers with this theme. */
  answering(original: typeof matchMedia): typeof matchMedia {
    return (query) => {
      const list = original(query);
      const wanted = QUERY.exec(query)?.[1];
      if (wanted) {
        Object.defineProperty(list, 'matches', { get: () => this.theme === wanted });
        this.lists.push(list);
      }
      return list;
    };
  }

  /** Changes the theme and calls the listeners. */
  set(theme: Theme): void {
    this.theme = theme;
    for (const list of this.lists) list.dispatchEvent(new Event('change'));
  }
}

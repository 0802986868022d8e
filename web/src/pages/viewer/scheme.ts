// The viewer draws dark or light as the system prefers: version 0.36 forgets its option `theme` at the first start.
// So the question that it puts to the browser is answered with the laboratory's theme.

import type { Theme } from '../../ui/theme';

const QUERY = /^\(prefers-color-scheme: (dark|light)\)$/;

/** The system's preference, replaced by a theme. */
export class Scheme {
  private readonly asked: MediaQueryList[] = [];

  constructor(private theme: Theme) {}

  /** A `matchMedia` that knows of this theme. */
  answering(original: typeof matchMedia): typeof matchMedia {
    return (query) => {
      const list = original(query);
      const wanted = QUERY.exec(query)?.[1];
      if (wanted) {
        Object.defineProperty(list, 'matches', { get: () => this.theme === wanted });
        this.asked.push(list);
      }
      return list;
    };
  }

  /** Changes the theme and tells those who listen. */
  set(theme: Theme): void {
    this.theme = theme;
    for (const list of this.asked) list.dispatchEvent(new Event('change'));
  }
}

// The kinds of windows that scripts need to know. Their sizes are those of styles/breakpoints.css.

import { createSignal, type Accessor } from 'solid-js';

function matches(query: string): Accessor<boolean> {
  const list = matchMedia(query);
  const [value, setValue] = createSignal(list.matches);
  list.addEventListener('change', () => setValue(list.matches));
  return value;
}

export const isPhone = matches('(max-width: 640px)');
/** The map is turned, so that it fills a high window. */
export const isUpright = matches('(max-width: 640px) and (orientation: portrait)');
export const isLow = matches('(max-height: 719px)');

// Whether the user wants less motion.

import { createSignal, onCleanup, type Accessor } from 'solid-js';

export function prefersLessMotion(): Accessor<boolean> {
  const query = matchMedia('(prefers-reduced-motion: reduce)');
  const [isLess, setLess] = createSignal(query.matches);
  const onChange = (): void => {
    setLess(query.matches);
  };
  query.addEventListener('change', onChange);
  onCleanup(() => query.removeEventListener('change', onChange));
  return isLess;
}

// The view's code is loaded when the view is opened: the eraser's geometry is a quarter of the page's code.

import { Suspense, lazy, type JSX } from 'solid-js';
import type { DrawProps } from './DrawView';

/** A newer version of the server may have other files. */
function Missing(): JSX.Element {
  return (
    <main class="view">
      <p class="placeholder" role="alert">
        This view could not be loaded. Reload the page.
      </p>
    </main>
  );
}

const View = lazy(async () => {
  try {
    const { DrawView } = await import('./DrawView');
    return { default: DrawView };
  } catch {
    return { default: Missing };
  }
});

export function LazyDrawView(props: DrawProps): JSX.Element {
  return (
    <Suspense fallback={<main class="view" />}>
      <View {...props} />
    </Suspense>
  );
}

// A part of the page whose code is loaded when it is first shown.

import { Suspense, lazy, type Component, type JSX } from 'solid-js';

/** A newer version of the server may have other files: then `missing` is shown. */
export function lazyPart<P extends object>(
  load: () => Promise<Component<P>>,
  waiting: () => JSX.Element,
  missing: () => JSX.Element,
): Component<P> {
  const Part = lazy(async () => ({ default: await load().catch(() => missing as Component<P>) }));
  return (props) => (
    <Suspense fallback={waiting()}>
      <Part {...props} />
    </Suspense>
  );
}

/** A view of the page. */
export function lazyView<P extends object>(load: () => Promise<Component<P>>): Component<P> {
  return lazyPart(
    load,
    () => <main class="view" />,
    () => (
      <main class="view">
        <p class="placeholder" role="alert">
          This view could not be loaded. Reload the page.
        </p>
      </main>
    ),
  );
}

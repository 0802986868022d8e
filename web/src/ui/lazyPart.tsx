// A part of the page whose code is loaded when it is first shown.

import { Suspense, lazy, type Component, type JSX } from 'solid-js';

/** Imports a file whose default export is the part. */
export type Load<P extends object> = () => Promise<{ default: Component<P> }>;

/** `frame` is shown until it is loaded, or around the words that it is missing: a newer version of the server may have other files. */
export function lazyPart<P extends object>(
  load: Load<P>,
  kind: string,
  frame: (missing?: JSX.Element) => JSX.Element,
): Component<P> {
  const Missing = (): JSX.Element =>
    frame(
      <p class="placeholder" role="alert">
        This {kind} could not be loaded. Reload the page.
      </p>,
    );
  const Part = lazy(() => load().catch(() => ({ default: Missing })));
  return (props) => (
    <Suspense fallback={frame()}>
      <Part {...props} />
    </Suspense>
  );
}

/** A view of the page. */
export const lazyView = <P extends object>(load: Load<P>): Component<P> =>
  lazyPart(load, 'view', (missing) => <main class="view">{missing}</main>);

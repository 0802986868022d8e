// The Lessons tab. Its code is loaded when the tab is opened for the first time.

import { Suspense, lazy, type JSX } from 'solid-js';
import type { PanelProps, TabPanel } from '../../lab/panel';

/** A newer version of the server may have other files. */
function Missing(): JSX.Element {
  return (
    <p class="placeholder" role="alert">
      The lessons could not be loaded. Reload the page.
    </p>
  );
}

const LazyLessons = lazy(async () => {
  try {
    const { LessonsPanel } = await import('./LessonsPanel');
    return { default: LessonsPanel };
  } catch {
    return { default: Missing };
  }
});

function Lessons(props: PanelProps): JSX.Element {
  return (
    <Suspense fallback={<p class="placeholder">Loading…</p>}>
      <LazyLessons lab={props.lab} />
    </Suspense>
  );
}

export const LESSONS_TAB: TabPanel = { id: 'lessons', title: 'Lessons', panel: Lessons };

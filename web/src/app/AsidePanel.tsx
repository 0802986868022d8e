// Beside the workspace: what happened, or a lesson.

import { Suspense, lazy, type JSX } from 'solid-js';
import { LogPanel } from '../features/events/EventsPanel';
import { Tabs, type Tab, type PanelProps } from '../ui/Tabs';

/** Another version of the server has other files. */
function Missing(): JSX.Element {
  return (
    <p class="placeholder" role="alert">
      The lessons could not be loaded; reload the page.
    </p>
  );
}

// Loaded when somebody wants to learn.
const LazyLessons = lazy(async () => {
  try {
    const { LessonsPanel } = await import('../features/lessons/LessonsPanel');
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

const TABS: readonly [Tab, ...Tab[]] = [
  { id: 'events', title: 'Events', panel: LogPanel },
  { id: 'lessons', title: 'Lessons', panel: Lessons },
];

export function AsidePanel(props: PanelProps): JSX.Element {
  return (
    <Tabs
      lab={props.lab}
      theme={props.theme}
      area="aside"
      label="Beside the workspace"
      tabs={TABS}
    />
  );
}

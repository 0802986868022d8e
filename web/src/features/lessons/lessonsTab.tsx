// The Lessons tab. Its code is loaded when the tab is opened for the first time.

import type { PanelProps, TabPanel } from '../../lab/panel';
import { lazyPart } from '../../ui/lazyPart';

const Lessons = lazyPart<PanelProps>(
  async () => (await import('./LessonsPanel')).LessonsPanel,
  () => <p class="placeholder">Loading…</p>,
  () => (
    <p class="placeholder" role="alert">
      The lessons could not be loaded. Reload the page.
    </p>
  ),
);

export const LESSONS_TAB: TabPanel = { id: 'lessons', title: 'Lessons', panel: Lessons };

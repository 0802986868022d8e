// The Challenge tab. Its code is loaded when the tab is opened for the first time.

import type { PanelProps, TabPanel } from '../../lab/panel';
import { lazyPart } from '../../ui/lazyPart';

const Challenge = lazyPart<PanelProps>(
  async () => (await import('./ChallengePanel')).ChallengePanel,
  () => <p class="placeholder">Loading…</p>,
  () => (
    <p class="placeholder" role="alert">
      The challenges could not be loaded. Reload the page.
    </p>
  ),
);

export const CHALLENGE_TAB: TabPanel = { id: 'challenge', title: 'Challenge', panel: Challenge };

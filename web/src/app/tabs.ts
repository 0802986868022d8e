// The panels of the tab areas, in tab order.

import { EVENTS_TAB } from '../features/events/EventsPanel';
import { PLOTS_TAB } from '../features/plots/PlotsPanel';
import { lazyTab, type TabPanel } from '../lab/panel';

type TabList = readonly [TabPanel, ...TabPanel[]];

export const LOWER_TABS: TabList = [
  PLOTS_TAB,
  lazyTab('Magnet', async () => (await import('../features/magnet/MagnetPanel')).MagnetPanel),
  lazyTab('Compare', async () => (await import('../features/compare/ComparePanel')).ComparePanel),
  lazyTab(
    'Recovery',
    async () => (await import('../features/recovery/RecoveryPanel')).RecoveryPanel,
  ),
  lazyTab(
    'Challenge',
    async () => (await import('../features/challenge/ChallengePanel')).ChallengePanel,
  ),
];
export const ASIDE_TABS: TabList = [
  EVENTS_TAB,
  lazyTab('Lessons', async () => (await import('../features/lessons/LessonsPanel')).LessonsPanel),
];

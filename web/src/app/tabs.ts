// The panels of the tab areas, in tab order.

import { EVENTS_TAB } from '../features/events/EventsPanel';
import { PLOTS_TAB } from '../features/plots/PlotsPanel';
import { lazyTab, type TabPanel } from '../lab/panel';

type TabList = readonly [TabPanel, ...TabPanel[]];

export const LOWER_TABS: TabList = [
  PLOTS_TAB,
  lazyTab('magnet', 'Magnet', () => import('../features/magnet/MagnetPanel')),
  lazyTab('compare', 'Compare', () => import('../features/compare/ComparePanel')),
  lazyTab('recovery', 'Recovery', () => import('../features/recovery/RecoveryPanel')),
  lazyTab('challenge', 'Challenge', () => import('../features/challenge/ChallengePanel')),
];
export const ASIDE_TABS: TabList = [
  EVENTS_TAB,
  lazyTab('lessons', 'Lessons', () => import('../features/lessons/LessonsPanel')),
];

// The panels of the tab areas, in tab order.

import { EVENTS_TAB } from '../features/events/EventsPanel';
import { PLOTS_TAB } from '../features/plots/PlotsPanel';
import { lazyTab, type TabPanel } from '../lab/panel';

type TabList = readonly [TabPanel, ...TabPanel[]];

export const LOWER_TABS: TabList = [
  PLOTS_TAB,
  lazyTab('Magnet', () => import('../features/magnet/MagnetPanel')),
  lazyTab('Compare', () => import('../features/compare/ComparePanel')),
  lazyTab('Recovery', () => import('../features/recovery/RecoveryPanel')),
  lazyTab('Challenge', () => import('../features/challenge/ChallengePanel')),
];
export const ASIDE_TABS: TabList = [
  EVENTS_TAB,
  lazyTab('Lessons', () => import('../features/lessons/LessonsPanel')),
];

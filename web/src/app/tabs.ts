// The panels of the tab areas, in tab order.

import { CHALLENGE_TAB } from '../features/challenge/challengeTab';
import { COMPARE_TAB } from '../features/compare/compareTab';
import { EVENTS_TAB } from '../features/events/EventsPanel';
import { LESSONS_TAB } from '../features/lessons/lessonsTab';
import { MAGNET_TAB } from '../features/magnet/magnetTab';
import { PLOTS_TAB } from '../features/plots/PlotsPanel';
import { RECOVERY_TAB } from '../features/recovery/recoveryTab';
import type { TabPanel } from '../lab/panel';

type TabList = readonly [TabPanel, ...TabPanel[]];

export const LOWER_TABS: TabList = [
  PLOTS_TAB,
  MAGNET_TAB,
  COMPARE_TAB,
  RECOVERY_TAB,
  CHALLENGE_TAB,
];
export const ASIDE_TABS: TabList = [EVENTS_TAB, LESSONS_TAB];

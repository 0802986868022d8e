// The panels of the inspector, and the tabs that they are under.

import type { Component } from 'solid-js';
import type { MapOpener } from '../features/maps/opener';
import type { PageExperiment } from '../lab/pageExperiment';
import type { PanelName } from '../lab/panels';
import { lazyPanel } from '../lab/panel';
import type { Lab } from '../lab/slices';
import type { Picker } from '../plan/interaction';
import type { LiveLayer } from '../plan/layer';
import { NowPanel } from './NowPanel';

/** What panels get beside the laboratory. */
export interface PageParts {
  readonly picker: Picker;
  readonly layers: readonly LiveLayer[];
  readonly links: PageExperiment;
  readonly opener: MapOpener;
  /** Opens the view Train with the map of the trial. */
  readonly onTrain: () => void;
}

export interface Panel {
  readonly name: PanelName;
  readonly title: string;
  readonly panel: Component<{ lab: Lab } & PageParts>;
}

/** Its first panel is opened by the tab; with more than one, a switch inside chooses. */
export interface Tab {
  readonly title: string;
  readonly panels: readonly [Panel, ...Panel[]];
}

const tab = (name: PanelName, title: string, panel: Panel['panel']): Tab => ({
  title,
  panels: [{ name, title, panel }],
});

export const TABS: readonly Tab[] = [
  tab('now', 'Now', NowPanel),
  tab(
    'story',
    'Story',
    lazyPanel(() => import('../features/events/EventsPanel')),
  ),
  tab(
    'learn',
    'Learn',
    lazyPanel(() => import('../features/lessons/LessonsPanel')),
  ),
  tab(
    'play',
    'Play',
    lazyPanel(() => import('../features/challenge/ChallengePanel')),
  ),
  {
    title: 'Test',
    panels: [
      {
        name: 'compare',
        title: 'Compare',
        panel: lazyPanel(() => import('../features/compare/ComparePanel')),
      },
      {
        name: 'recovery',
        title: 'Recovery',
        panel: lazyPanel(() => import('../features/recovery/RecoveryPanel')),
      },
      {
        name: 'disturb',
        title: 'Disturb',
        panel: lazyPanel(() => import('../features/disturb/DisturbPanel')),
      },
    ],
  },
  tab(
    'tune',
    'Tune',
    lazyPanel(() => import('./TunePanel')),
  ),
];

export const EXTRA_PANELS: readonly Panel[] = [
  {
    name: 'setup',
    title: 'Set up',
    panel: lazyPanel(() => import('./SetUpPanel')),
  },
  {
    name: 'layers',
    title: 'Layers',
    panel: lazyPanel(() => import('./LayersPanel')),
  },
];

export const tabOf = (panel: PanelName): Tab | undefined =>
  TABS.find(({ panels }) => panels.some(({ name }) => name === panel));

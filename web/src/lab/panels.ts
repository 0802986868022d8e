// The panels of the inspector, one at a time.

import { createSignal } from 'solid-js';
import { isPhone } from '../ui/windowSize';
import { createChoice } from '../ui/storage';

/** Those under the tabs; the first one is open on the first visit. */
const TABBED = ['now', 'story', 'learn', 'play', 'compare', 'recovery', 'disturb', 'tune'] as const;

export type TabbedPanel = (typeof TABBED)[number];
/** The others are opened by a button of the top bar, and closed. */
export type PanelName = TabbedPanel | 'setup' | 'layers';

const isTabbed = (panel: PanelName): panel is TabbedPanel =>
  panel !== 'setup' && panel !== 'layers';

export type Panels = ReturnType<typeof createPanels>;

export function createPanels() {
  const [tab, setTab] = createChoice('panel', TABBED);
  const [opened, setOpened] = createSignal<PanelName>();
  const [inspector, setInspector] = createChoice('inspector', ['shown', 'hidden']);
  // On a phone it is a sheet over the map, and closed at first.
  const [sheet, setSheet] = createSignal(false);
  const isShown = (): boolean => (isPhone() ? sheet() : inspector() === 'shown');
  const [fills, setFills] = createSignal(false);
  const show = (shown: boolean): void => {
    setFills(false);
    if (isPhone()) setSheet(shown);
    else setInspector(shown ? 'shown' : 'hidden');
  };
  return {
    /** The open panel; undefined while the inspector is hidden. */
    panel: (): PanelName | undefined => (isShown() ? (opened() ?? tab()) : undefined),
    showPanel: (panel: PanelName) => {
      if (isTabbed(panel)) setTab(panel);
      setOpened(isTabbed(panel) ? undefined : panel);
      show(true);
    },
    /** Closes a panel without a tab; otherwise hides the inspector. */
    closePanel: () => {
      if (opened() === undefined || isPhone()) show(false);
      setOpened(undefined);
    },
    /** Hides the inspector, or shows its last panel again. */
    toggleInspector: () => show(!isShown()),
    /** Whether the map fills its place; nothing else enlarges it. */
    fills,
    /** Fills it without the inspector, or ends that. */
    toggleFill: () => {
      const next = !fills();
      if (next) show(false);
      setFills(next);
    },
  };
}

// Below the workspace: the plots against time, or what the magnet can do.

import type { JSX } from 'solid-js';
import { MagnetPanel } from './MagnetPanel';
import { PlotsPanel } from './PlotsPanel';
import { Tabs, type Tab, type TabProps } from './Tabs';

const TABS: readonly [Tab, ...Tab[]] = [
  { id: 'plots', title: 'Plots', panel: PlotsPanel },
  { id: 'magnet', title: 'Magnet', panel: MagnetPanel },
];

export function LowerPanel(props: TabProps): JSX.Element {
  return (
    <Tabs
      lab={props.lab}
      theme={props.theme}
      area="lower"
      label="Below the workspace"
      tabs={TABS}
    />
  );
}

// Below the workspace: the plots against time, what the magnet can do, or how controllers compare.

import type { JSX } from 'solid-js';
import { ComparePanel } from './ComparePanel';
import { MagnetPanel } from './MagnetPanel';
import { PlotsPanel } from './PlotsPanel';
import { Tabs, type Tab, type TabProps } from './Tabs';

const TABS: readonly [Tab, ...Tab[]] = [
  { id: 'plots', title: 'Plots', panel: PlotsPanel },
  { id: 'magnet', title: 'Magnet', panel: MagnetPanel },
  { id: 'compare', title: 'Compare', panel: ComparePanel },
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

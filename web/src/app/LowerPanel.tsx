// Below the workspace: the plots against time, what the magnet can do, or how controllers compare.

import { createSignal, type JSX } from 'solid-js';
import { ComparePanel } from '../features/compare/ComparePanel';
import { MagnetPanel } from '../features/magnet/MagnetPanel';
import { PlotsPanel } from '../features/plots/PlotsPanel';
import { Tabs, type Tab, type PanelProps } from '../ui/Tabs';

const TABS: readonly [Tab, ...Tab[]] = [
  { id: 'plots', title: 'Plots', panel: PlotsPanel },
  { id: 'magnet', title: 'Magnet', panel: MagnetPanel },
  { id: 'compare', title: 'Compare', panel: ComparePanel },
];

export function LowerPanel(props: PanelProps): JSX.Element {
  const [large, setLarge] = createSignal(false);
  return (
    <Tabs
      lab={props.lab}
      theme={props.theme}
      area="lower"
      label="Below the workspace"
      tabs={TABS}
      aside={
        <button
          type="button"
          class="small enlarge"
          aria-pressed={large()}
          title="Gives this panel more of the page's height"
          onClick={() => {
            setLarge(!large());
          }}
        >
          Larger
        </button>
      }
    />
  );
}

// The panel below the workspace: plots, magnet, or comparison.

import { createSignal, type JSX } from 'solid-js';
import { TabArea } from './TabArea';
import { LOWER_TABS } from './tabs';
import type { Lab } from '../lab/slices';
import './LowerPanel.css';

export function LowerPanel(props: { lab: Lab }): JSX.Element {
  const [large, setLarge] = createSignal(false);
  return (
    <TabArea
      lab={props.lab}
      area="lower"
      label="Below the workspace"
      tabs={LOWER_TABS}
      aside={
        <button
          type="button"
          class="small enlarge"
          aria-pressed={large()}
          title="Makes this panel taller"
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

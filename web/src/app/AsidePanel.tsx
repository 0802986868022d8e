// The panel beside the workspace: events or lessons.

import type { JSX } from 'solid-js';
import { TabArea } from './TabArea';
import { ASIDE_TABS } from './tabs';
import type { Lab } from '../lab/slices';

export function AsidePanel(props: { lab: Lab }): JSX.Element {
  return <TabArea lab={props.lab} area="aside" label="Beside the workspace" tabs={ASIDE_TABS} />;
}

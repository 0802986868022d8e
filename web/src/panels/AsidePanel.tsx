// Beside the workspace: what happened, or a lesson.

import type { JSX } from 'solid-js';
import { LogPanel } from './LogPanel';
import { Tabs, type Tab, type PanelProps } from './Tabs';

const TABS: readonly [Tab, ...Tab[]] = [{ id: 'events', title: 'Events', panel: LogPanel }];

export function AsidePanel(props: PanelProps): JSX.Element {
  return (
    <Tabs
      lab={props.lab}
      theme={props.theme}
      area="aside"
      label="Beside the workspace"
      tabs={TABS}
    />
  );
}

// Beside the workspace: what happened, or a lesson.

import type { JSX } from 'solid-js';
import { LogPanel } from './LogPanel';
import { Tabs, type Tab, type TabProps } from './Tabs';

const TABS: readonly [Tab, ...Tab[]] = [{ id: 'events', title: 'Events', panel: LogPanel }];

export function AsidePanel(props: TabProps): JSX.Element {
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

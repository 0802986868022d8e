// A tab area of the laboratory.

import type { JSX } from 'solid-js';
import { Dynamic } from 'solid-js/web';
import type { TabPanel } from '../lab/panel';
import { Tabs } from '../ui/Tabs';
import type { Lab } from '../lab/slices';

export function TabArea(props: {
  lab: Lab;
  area: string;
  label: string;
  tabs: readonly [TabPanel, ...TabPanel[]];
  aside?: JSX.Element;
}): JSX.Element {
  return (
    <Tabs
      area={props.area}
      label={props.label}
      tabs={props.tabs}
      opened={props.lab.opened()?.tab}
      onOpened={() => {
        props.lab.openTab(undefined);
      }}
      aside={props.aside}
    >
      {(tab, tools) => <Dynamic component={tab.panel} lab={props.lab} tools={tools} />}
    </Tabs>
  );
}

// Experiments by name. Shows the name of the page's experiment while it is unchanged.

import { createMemo, type JSX } from 'solid-js';
import type { PageExperiment } from '../../lab/pageExperiment';
import { PRESETS } from './presets';
import { ServerSelect } from '../../ui/ServerSelect';
import type { Session } from '../../lab/slices';

const NONE = '';
const OPTIONS = [
  [NONE, 'Preset…'] as const,
  ...Object.entries(PRESETS).map(([name, link]) => [link, name] as const),
];

export function PresetSelect(props: { lab: Session; links: PageExperiment }): JSX.Element {
  const { lab, links } = props;
  const value = createMemo(() => {
    const now = links.now();
    return Object.values(PRESETS).find((link) => link === now) ?? NONE;
  });
  return (
    <ServerSelect
      label="Preset"
      value={value()}
      options={OPTIONS}
      disabled={!lab.canOperate()}
      onChoose={async (link) => {
        if (link !== NONE) await links.open(link);
      }}
    />
  );
}

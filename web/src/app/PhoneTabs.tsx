// The tabs at the foot of a phone.

import { For, Show, type JSX } from 'solid-js';
import { BookOpen, Ellipsis, FlaskConical, type IconNode, ScrollText, Trophy } from 'lucide';
import type { PanelName } from '../lab/panels';
import type { Lab } from '../lab/slices';
import { Icon } from '../ui/Icon';
import { isPhone } from '../ui/windowSize';
import './PhoneTabs.css';

/** Without a panel: the map alone. */
const TABS: readonly (readonly [string, IconNode, PanelName | undefined])[] = [
  ['Steer', FlaskConical, undefined],
  ['Learn', BookOpen, 'learn'],
  ['Play', Trophy, 'play'],
  ['Story', ScrollText, 'story'],
  ['More', Ellipsis, 'now'],
];

export function PhoneTabs(props: { lab: Lab }): JSX.Element {
  const { lab } = props;
  return (
    <Show when={isPhone()}>
      <nav class="phone-tabs" aria-label="Panels">
        <For each={TABS}>
          {([title, icon, panel]) => (
            <button
              type="button"
              aria-current={lab.panel() === panel ? 'true' : undefined}
              onClick={() => {
                if (panel === undefined || lab.panel() === panel) {
                  if (lab.panel() !== undefined) lab.closePanel();
                } else lab.showPanel(panel);
              }}
            >
              <Icon of={icon} />
              {title}
            </button>
          )}
        </For>
      </nav>
    </Show>
  );
}

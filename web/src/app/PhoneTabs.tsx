// The tabs at the foot of a phone. *More* has what has no tab.

import { For, Show, createEffect, on, type JSX } from 'solid-js';
import { BookOpen, Ellipsis, FlaskConical, type IconNode, ScrollText, Trophy } from 'lucide';
import { Transport } from '../features/playback/Transport';
import type { PanelName } from '../lab/panels';
import type { Lab } from '../lab/slices';
import { Icon } from '../ui/Icon';
import { createPopover } from '../ui/popover';
import { isPhone } from '../ui/windowSize';
import { HelpButton } from './Help';
import { ThemeButton } from './ThemeButton';
import { ViewLinks } from './ViewLinks';
import './PhoneTabs.css';

/** Without a panel: the map alone. */
const TABS: readonly (readonly [string, IconNode, PanelName | undefined])[] = [
  ['Steer', FlaskConical, undefined],
  ['Learn', BookOpen, 'learn'],
  ['Play', Trophy, 'play'],
  ['Story', ScrollText, 'story'],
];
const PANELS: readonly (readonly [string, PanelName])[] = [
  ['Now', 'now'],
  ['Compare', 'compare'],
  ['Recovery', 'recovery'],
  ['Disturb', 'disturb'],
  ['Tune', 'tune'],
  ['Layers', 'layers'],
  ['Set up', 'setup'],
];

export function PhoneTabs(props: { lab: Lab }): JSX.Element {
  const { lab } = props;
  const more = createPopover('more-panels');
  createEffect(
    on(
      lab.address.view,
      () => {
        if (more.open()) more.close();
      },
      { defer: true },
    ),
  );
  const open = (panel: PanelName | undefined): void => {
    lab.address.show('laboratory');
    if (panel === undefined || lab.panel() === panel) {
      if (lab.panel() !== undefined) lab.closePanel();
    } else lab.showPanel(panel);
  };
  const isCurrent = (panel: PanelName | undefined): boolean =>
    lab.address.view() === 'laboratory' && lab.panel() === panel;
  return (
    <Show when={isPhone()}>
      <nav class="phone-tabs" aria-label="Panels">
        <For each={TABS}>
          {([title, icon, panel]) => (
            <button
              type="button"
              aria-current={isCurrent(panel) ? 'true' : undefined}
              onClick={() => {
                open(panel);
              }}
            >
              <Icon of={icon} />
              {title}
            </button>
          )}
        </For>
        <div {...more.box} class="phone-more">
          <button {...more.button}>
            <Icon of={Ellipsis} />
            More
          </button>
          <Show when={more.open()}>
            <div id="more-panels" class="popover" role="group" aria-label="More panels and views">
              <div class="phone-panels">
                <For each={PANELS}>
                  {([title, panel]) => (
                    <button
                      type="button"
                      onClick={() => {
                        more.close();
                        open(panel);
                      }}
                    >
                      {title}
                    </button>
                  )}
                </For>
              </div>
              <Show when={lab.address.view() === 'laboratory'}>
                <Transport lab={lab} inMenu />
              </Show>
              <ViewLinks lab={lab} />
              <div class="phone-foot">
                <HelpButton />
                <ThemeButton />
              </div>
              <p>Simulation, not safety-rated</p>
            </div>
          </Show>
        </div>
      </nav>
    </Show>
  );
}

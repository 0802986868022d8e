// The rail at the left: the views, the help and the theme.

import { Show, type JSX } from 'solid-js';
import type { Addressed } from '../lab/slices';
import { isPhone } from '../ui/windowSize';
import { HelpButton } from './Help';
import { Logo } from './Logo';
import { ThemeButton } from './ThemeButton';
import { ViewLinks } from './ViewLinks';
import './Rail.css';

export function Rail(props: { lab: Addressed }): JSX.Element {
  return (
    <Show when={!isPhone()}>
      <header class="rail">
        <h1>
          <Logo />
          <span class="visually-hidden">Ferry</span>
        </h1>
        <ViewLinks lab={props.lab} />
        <div class="rail-foot">
          <p>Simulation, not safety-rated</p>
          <HelpButton />
          <ThemeButton />
        </div>
      </header>
    </Show>
  );
}

// The views, the help and the theme.

import { For, type JSX } from 'solid-js';
import {
  Brain,
  ChartColumn,
  Clapperboard,
  FlaskConical,
  type IconNode,
  Moon,
  PencilRuler,
  Sun,
} from 'lucide';
import { VIEWS, type View } from '../lab/address';
import type { Addressed, Lab } from '../lab/slices';
import { Icon } from '../ui/Icon';
import { theme, toggleTheme } from '../ui/theme';
import { Help } from './Help';
import { Logo } from './Logo';
import './Rail.css';

const ICONS: Readonly<Record<View, IconNode>> = {
  laboratory: FlaskConical,
  draw: PencilRuler,
  train: Brain,
  recordings: Clapperboard,
  evaluate: ChartColumn,
};

function ViewLink(props: { lab: Addressed; view: View }): JSX.Element {
  const { address } = props.lab;
  return (
    <a
      href={address.of(props.view)}
      aria-current={address.view() === props.view ? 'page' : undefined}
      onClick={(event) => {
        // With a modifier, the browser opens another tab or window.
        if (event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return;
        event.preventDefault();
        address.show(props.view);
      }}
    >
      <Icon of={ICONS[props.view]} />
      {VIEWS[props.view]}
    </a>
  );
}

export function Rail(props: { lab: Lab }): JSX.Element {
  return (
    <header class="rail">
      <h1>
        <Logo />
        <span class="visually-hidden">Ferry</span>
      </h1>
      <nav aria-label="Views">
        <For each={Object.keys(VIEWS) as View[]}>
          {(view) => <ViewLink lab={props.lab} view={view} />}
        </For>
      </nav>
      <div class="rail-foot">
        <p>Simulation, not safety-rated</p>
        <Help lab={props.lab} />
        <button type="button" onClick={toggleTheme}>
          <Icon of={theme() === 'dark' ? Sun : Moon} />
          {theme() === 'dark' ? 'Light' : 'Dark'}
        </button>
      </div>
    </header>
  );
}

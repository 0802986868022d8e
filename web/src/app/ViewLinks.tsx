// Links to the views of the page.

import { For, type JSX } from 'solid-js';
import { Brain, ChartColumn, Clapperboard, FlaskConical, type IconNode, PencilRuler } from 'lucide';
import { VIEWS, type View } from '../lab/address';
import type { Addressed } from '../lab/slices';
import { Icon } from '../ui/Icon';

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

export function ViewLinks(props: { lab: Addressed }): JSX.Element {
  return (
    <nav aria-label="Views">
      <For each={Object.keys(VIEWS) as View[]}>
        {(view) => <ViewLink lab={props.lab} view={view} />}
      </For>
    </nav>
  );
}

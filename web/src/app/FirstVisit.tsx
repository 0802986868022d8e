// The first visit: the scene, one sentence, and three ways to begin. While another browser steers, each of them leads to a
// session of the visitor's own, and begins there.

import { Show, createEffect, createSignal, type JSX } from 'solid-js';
import { ArrowRight, BookOpen, HandGrab, type IconNode, Trophy } from 'lucide';
import { openOwn } from '../lab/ownSession';

import type { Lab } from '../lab/slices';
import type { Interaction } from '../plan/interaction';
import type { LiveLayer } from '../plan/layer';
import { firstView } from '../scene/graphics';
import { MapView } from '../scene/MapView';
import { reasonText } from '../net/problem';
import { capital } from '../ui/format';
import { Icon } from '../ui/Icon';
import { tabStorage } from '../ui/storage';
import { Logo } from './Logo';
import './FirstVisit.css';

const HELP_ID = 'first-visit-help';
/** The picture stands at the right of the sentence. */
const SHIFT = 0.15;
/** Where the way is kept that was chosen in another session. */
const WAY = 'ferry.way';
/** Each opens the panel of its name. */
const WAYS = ['now', 'play', 'learn'] as const;
type Way = (typeof WAYS)[number];

export function FirstVisit(props: {
  lab: Lab;
  interaction: Interaction;
  layers: readonly LiveLayer[];
  onEnd: () => void;
}): JSX.Element {
  const { lab, interaction } = props;
  const view = firstView();
  const bead = () => {
    const [now, at] = [interaction.view(), lab.state()?.bead_m];
    return now && at && now.toPx([at[0], at[1]]);
  };
  // A pull begins the trial: the arm fetches the bead.
  createEffect(() => {
    if (interaction.act().kind === 'held' && lab.canOperate() && !lab.state()?.running)
      void lab.send('workspace', { type: 'run' });
  });
  const isWatching = (): boolean => lab.hello()?.role === 'viewer';
  const [refused, setRefused] = createSignal<string>();
  const begin = (panel: Way): void => {
    if (isWatching()) {
      tabStorage().setItem(WAY, panel);
      openOwn().catch((reason: unknown) => {
        tabStorage().removeItem(WAY);
        setRefused(capital(reasonText(reason)));
      });
      return;
    }
    if (panel === 'now' && lab.canOperate()) void lab.send('playback', { type: 'run' });
    lab.showPanel(panel);
    props.onEnd();
  };
  const chosen = WAYS.find((panel) => panel === tabStorage().getItem(WAY));
  createEffect(() => {
    if (chosen === undefined || !lab.canOperate()) return;
    tabStorage().removeItem(WAY);
    begin(chosen);
  });
  const Chip = (own: {
    class?: string;
    icon: IconNode;
    label: string;
    panel: Way;
  }): JSX.Element => (
    <button
      type="button"
      class={`chip ${own.class ?? ''}`}
      onClick={() => {
        begin(own.panel);
      }}
    >
      <Icon of={own.icon} />
      {own.label}
    </button>
  );
  return (
    <main class="first-visit" data-view={view}>
      <div class="first-map">
        <MapView
          lab={lab}
          interaction={interaction}
          layers={props.layers}
          helpId={HELP_ID}
          mode={view}
          shift={SHIFT}
          onPlan={props.onEnd}
        />
        <Show when={lab.canOperate() && bead()}>
          {(px) => (
            <span
              class="tag"
              aria-hidden="true"
              style={{ left: `${px()[0]}px`, top: `${px()[1]}px` }}
            >
              Drag me
            </span>
          )}
        </Show>
      </div>
      <div class="hello">
        <header>
          <h1>
            <Logo />
            Ferry
          </h1>
          <button type="button" class="ghost" onClick={props.onEnd}>
            {isWatching() ? 'Watch' : 'Open the lab'}
            <Icon of={ArrowRight} />
          </button>
        </header>
        <div class="hello-words">
          <p id={HELP_ID}>
            A magnet on a robot arm carries this bead through a gut. Try to take it away.
          </p>
          <div class="chips">
            <Chip class="primary" icon={HandGrab} label="Pull it away" panel="now" />
            <Chip icon={Trophy} label="Race it" panel="play" />
            <Chip icon={BookOpen} label="Learn" panel="learn" />
          </div>
          <div class="first-note" role="status">
            <Show when={isWatching()}>
              {refused() ?? 'Another browser steers this one: you get a session of your own.'}
            </Show>
          </div>
        </div>
        <p class="safety">Simulation, not safety-rated</p>
      </div>
    </main>
  );
}

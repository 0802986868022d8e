// The first visit: the scene, one sentence, and three ways to begin.

import { Show, createEffect, type JSX } from 'solid-js';
import { ArrowRight, BookOpen, HandGrab, type IconNode, Trophy } from 'lucide';
import type { PanelName } from '../lab/panels';
import type { Lab } from '../lab/slices';
import type { Interaction } from '../plan/interaction';
import type { LiveLayer } from '../plan/layer';
import { firstView } from '../scene/graphics';
import { MapView } from '../scene/MapView';
import { Icon } from '../ui/Icon';
import { Logo } from './Logo';
import './FirstVisit.css';

const HELP_ID = 'first-visit-help';
/** The picture stands at the right of the sentence. */
const SHIFT = 0.15;

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
  const begin = (panel: PanelName): void => {
    lab.showPanel(panel);
    props.onEnd();
  };
  const Chip = (own: { icon: IconNode; label: string; panel: PanelName }): JSX.Element => (
    <button
      type="button"
      class="chip"
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
        <Show when={bead()}>
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
            Open the lab
            <Icon of={ArrowRight} />
          </button>
        </header>
        <div class="hello-words">
          <p id={HELP_ID}>
            A magnet on a robot arm carries this bead through a gut. Try to take it away.
          </p>
          <div class="chips">
            <button
              type="button"
              class="chip primary"
              onClick={() => {
                if (lab.canOperate()) void lab.send('playback', { type: 'run' });
                begin('now');
              }}
            >
              <Icon of={HandGrab} />
              Pull it away
            </button>
            <Chip icon={Trophy} label="Race it" panel="play" />
            <Chip icon={BookOpen} label="Learn" panel="learn" />
          </div>
        </div>
        <p class="safety">Simulation, not safety-rated</p>
      </div>
    </main>
  );
}

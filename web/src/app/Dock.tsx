// The dock: plots, the time line, and what acts on time: run, who steers, disturb.

import { Show, type JSX } from 'solid-js';
import { Activity, HandGrab, Radio } from 'lucide';
import { SteeredBy } from '../features/controller/SteeredBy';
import { Timeline } from '../features/playback/Timeline';
import { Transport } from '../features/playback/Transport';
import { KeptRuns } from '../features/runs/KeptRuns';
import { PlaceNotice } from '../lab/PlaceNotice';
import type { Lab } from '../lab/slices';
import { clock } from '../ui/format';
import { Icon } from '../ui/Icon';
import { lazyPanel } from '../lab/panel';
import './Dock.css';

const PlotLanes = lazyPanel(() => import('../features/plots/PlotsPanel'));

/** Goes to the newest moment. */
function Live(props: { lab: Lab }): JSX.Element {
  const { lab } = props;
  const isPast = (): boolean => {
    const state = lab.state();
    return state !== undefined && state.tick < state.newest_tick;
  };
  return (
    <button
      type="button"
      class="small live"
      disabled={!lab.canOperate() || !isPast()}
      title={isPast() ? 'To the newest moment' : 'This is the newest moment'}
      onClick={() => {
        void lab.send('playback', { type: 'rewind', tick: lab.state()?.newest_tick ?? 0 });
      }}
    >
      <Icon of={Radio} />
      Live
    </button>
  );
}

export function Dock(props: {
  lab: Lab;
  hasPlots: boolean;
  onPlots: (shown: boolean) => void;
}): JSX.Element {
  const { lab } = props;
  const disturbs = (): boolean => lab.panel() === 'disturb';
  return (
    <footer class="dock" role="region" aria-label="Playback">
      <PlaceNotice lab={lab} place="workspace" />
      <PlaceNotice lab={lab} place="playback" />
      <Show when={props.hasPlots}>
        <div class="lanes">
          <PlotLanes lab={lab} />
        </div>
      </Show>
      <div class="time-row">
        <span
          class="sim-time number"
          data-testid="sim-time"
          title={`tick ${lab.state()?.tick ?? 0}`}
        >
          {clock(lab.state()?.sim_time_s ?? 0)}
        </span>
        <Timeline lab={lab} />
        <Live lab={lab} />
      </div>
      <div class="transport">
        <Transport lab={lab} />
        <SteeredBy lab={lab} />
        <div class="dock-tools">
          <button
            type="button"
            aria-pressed={disturbs()}
            disabled={!lab.canOperate()}
            onClick={() => {
              if (disturbs()) lab.closePanel();
              else lab.showPanel('disturb');
            }}
          >
            <Icon of={HandGrab} />
            <span>Disturb</span>
          </button>
          <button
            type="button"
            aria-label="Plots"
            aria-pressed={props.hasPlots}
            title="Plots (P)"
            onClick={() => {
              props.onPlots(!props.hasPlots);
            }}
          >
            <Icon of={Activity} />
            <span>Plots</span>
          </button>
          <KeptRuns lab={lab} />
        </div>
      </div>
    </footer>
  );
}

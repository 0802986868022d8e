// The dock: plots, the time line, and what acts on time: run, who steers, disturb.

import { Match, Show, Switch, type JSX } from 'solid-js';
import { Activity, HandGrab, Radio } from 'lucide';
import { StageBar } from '../features/challenge/StageBar';
import { SteeredBy } from '../features/controller/SteeredBy';
import { Timeline } from '../features/playback/Timeline';
import { Transport } from '../features/playback/Transport';
import { Handover } from '../features/handover/Handover';
import { Watching } from '../features/handover/Watching';
import { KeptRuns } from '../features/runs/KeptRuns';
import { hasLanes, hasLargeLanes, toggleLanes } from '../lab/lanes';
import { lazyPanel } from '../lab/panel';
import { PlaceNotice } from '../lab/PlaceNotice';
import type { Lab } from '../lab/slices';
import { createTimeAxis, type TimeAxis } from '../lab/timeAxis';
import type { ComparisonMessage } from '../net/protocol.gen';
import { clock } from '../ui/format';
import { Icon } from '../ui/Icon';
import { lazyPart } from '../ui/lazyPart';
import { isPhone } from '../ui/windowSize';
import './Dock.css';

const CompareLine = lazyPart(
  () => import('../features/compare/CompareLine'),
  'panel',
  (missing) => missing ?? <div class="track" />,
);
const TaskBar = lazyPanel(() => import('../features/lessons/TaskBar'));
const PlotLanes = lazyPanel(() => import('../features/plots/PlotLanes'));

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

/** The present time, and the time under a pointer, across all lanes. */
function Cursors(props: { axis: TimeAxis }): JSX.Element {
  const { axis } = props;
  const left = (time_s: number): string => `${(100 * axis.share(time_s)).toFixed(3)}%`;
  return (
    <div class="cursors" aria-hidden="true">
      <span class="cursor" style={{ left: left(axis.now_s()) }} />
      <Show when={axis.pointed_s()}>
        {(time_s) => (
          <span class="cursor pointed number" style={{ left: left(time_s()) }}>
            {clock(time_s())}
          </span>
        )}
      </Show>
    </div>
  );
}

function PlotsButton(): JSX.Element {
  return (
    <button
      type="button"
      aria-label="Plots"
      aria-pressed={hasLanes()}
      title="Plots (P)"
      onClick={toggleLanes}
    >
      <Icon of={Activity} />
      <span>Plots</span>
    </button>
  );
}

export function Dock(props: { lab: Lab }): JSX.Element {
  const { lab } = props;
  /** A phone has no room for it. */
  const timed = (): ComparisonMessage | undefined =>
    !isPhone() && lab.panel() === 'compare' ? lab.comparison.shown() : undefined;
  const axis = createTimeAxis(lab, timed);
  const disturbs = (): boolean => lab.panel() === 'disturb';
  const watches = (): boolean => lab.connection().kind === 'live' && lab.hello()?.role === 'viewer';
  const tick = (): string => `Tick ${lab.state()?.tick ?? 0}`;
  return (
    <footer class="dock" role="region" aria-label="Playback">
      <div class="dock-notices">
        <PlaceNotice lab={lab} place="workspace" />
        <PlaceNotice lab={lab} place="playback" />
        <PlaceNotice lab={lab} place="controller" />
        <Handover lab={lab} />
      </div>
      <div class="times">
        <Show when={hasLanes()}>
          <div class="lanes" classList={{ large: hasLargeLanes() }}>
            <PlotLanes lab={lab} axis={axis} />
            <Cursors axis={axis} />
          </div>
        </Show>
        <div class="time-row">
          <span class="sim-time number" data-testid="sim-time" title={tick()}>
            {clock(axis.now_s())}
          </span>
          <Show when={timed()} fallback={<Timeline lab={lab} axis={axis} />}>
            {(comparison) => (
              <CompareLine
                lab={lab}
                comparison={comparison()}
                axis={axis}
                tick_s={lab.scene()?.tick_s ?? 0}
              />
            )}
          </Show>
          <Live lab={lab} />
        </div>
      </div>
      <Show
        when={!watches()}
        fallback={
          <Watching lab={lab}>
            <PlotsButton />
          </Watching>
        }
      >
        <div class="transport">
          <Transport lab={lab} />
          <Switch fallback={<SteeredBy lab={lab} />}>
            <Match when={isPhone() && lab.contest.attempt()}>
              <StageBar lab={lab} />
            </Match>
            <Match when={isPhone() && lab.address.lesson()}>
              <TaskBar lab={lab}>
                <SteeredBy lab={lab} />
              </TaskBar>
            </Match>
          </Switch>
          <div class="dock-tools">
            <button
              type="button"
              aria-label="Disturb"
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
            <PlotsButton />
            <KeptRuns lab={lab} />
          </div>
        </div>
      </Show>
    </footer>
  );
}

// The top bar: which experiment, what happens now, and how it is shown.

import { Show, type JSX } from 'solid-js';
import { Box, ChevronDown, Layers, Map as MapIcon, PanelRightClose, PanelRightOpen } from 'lucide';
import { challengeTitle } from '../features/challenge/words';
import { PlaceNotice } from '../lab/PlaceNotice';
import { VIEWS } from '../lab/address';
import type { Lab } from '../lab/slices';
import { loggedOut } from '../net/access';
import { counted } from '../ui/format';
import { Icon } from '../ui/Icon';
import { shownName } from '../ui/name';
import { Segmented } from '../ui/Segmented';
import { lazyPart } from '../ui/lazyPart';
import { isPhone } from '../ui/windowSize';
import { MoreMenu } from './MoreMenu';
import { StatusPill } from './StatusPill';
import { VIEW_MODES, type ViewMode } from './viewMode';
import './TopBar.css';

const JobsButton = lazyPart(
  () => import('../features/jobs/JobsButton'),
  'list of jobs',
  () => undefined,
);

/** The map, and what the trial begins with. A press opens *Set up*. */
function Experiment(props: { lab: Lab }): JSX.Element {
  const { lab } = props;
  const disturbances = (): string => {
    const { length } = lab.scene()?.scenario.script ?? [];
    return length === 0 ? 'No disturbance' : counted(length, 'disturbance');
  };
  return (
    <Show when={lab.scene()}>
      {(scene) => (
        <button
          type="button"
          class="experiment"
          title="Set up: map, preset, seed"
          aria-expanded={lab.panel() === 'setup'}
          onClick={() => {
            if (lab.panel() === 'setup') lab.closePanel();
            else lab.showPanel('setup');
          }}
        >
          <Icon of={MapIcon} />
          <span>
            <b>{scene().challenge ? 'Challenge' : shownName(scene().map)}</b>
            <small>
              <Show when={scene().challenge} fallback={`${disturbances()} · seed ${scene().seed}`}>
                {(name) => `${challengeTitle(name())} · ${shownName(scene().map)}`}
              </Show>
              <Show when={scene().positioner === 'planar_stage'}>
                {' · '}
                <span data-testid="positioner">planar stage, no arm</span>
              </Show>
            </small>
          </span>
          <Icon of={ChevronDown} class="chevron" />
        </button>
      )}
    </Show>
  );
}

export function TopBar(props: {
  lab: Lab;
  mode: ViewMode;
  onMode: (mode: ViewMode) => void;
  /** Beside the layers. */
  share: JSX.Element;
}): JSX.Element {
  const { lab } = props;
  const isLaboratory = (): boolean => lab.address.view() === 'laboratory';
  const isTrouble = (): boolean =>
    loggedOut() || lab.ended() !== undefined || lab.connection().kind !== 'live';
  return (
    <section class="top" aria-label="Experiment">
      <Show
        when={isLaboratory()}
        fallback={<h2 class="view-title">{VIEWS[lab.address.view()]}</h2>}
      >
        <Experiment lab={lab} />
      </Show>
      {/* Elsewhere only what is wrong with the session. */}
      <Show when={isLaboratory() || isTrouble()}>
        <StatusPill lab={lab} />
      </Show>
      <div class="top-tools">
        <PlaceNotice lab={lab} place="session" />
        <Show when={isLaboratory()}>
          <Show
            when={!isPhone()}
            fallback={
              <button
                type="button"
                class="icon-only"
                aria-label="3-D"
                aria-pressed={props.mode === 'scene'}
                disabled={lab.sight() !== 'all'}
                onClick={() => props.onMode(props.mode === 'scene' ? 'plan' : 'scene')}
              >
                <Icon of={Box} />
              </button>
            }
          >
            <Segmented
              label="View"
              name="workspace-view"
              value={lab.sight() === 'all' ? props.mode : 'plan'}
              segments={VIEW_MODES.map(([value, label]) => ({ value, label }))}
              // Fog and camera have no 3-D view.
              disabled={lab.sight() !== 'all'}
              onChoose={(mode) => props.onMode(mode)}
            />
          </Show>
          <button
            type="button"
            class="layers-button"
            aria-label="Layers"
            aria-pressed={lab.panel() === 'layers'}
            onClick={() => {
              if (lab.panel() === 'layers') lab.closePanel();
              else lab.showPanel('layers');
            }}
          >
            <Icon of={Layers} />
            <span>Layers</span>
          </button>
          {props.share}
        </Show>
        <Show when={(lab.catalog.jobs()?.length ?? 0) > 0}>
          <JobsButton lab={lab} />
        </Show>
        <MoreMenu lab={lab} />
        <Show when={isLaboratory()}>
          <button
            type="button"
            class="ghost icon-only toggle-inspector"
            aria-label={lab.panel() === undefined ? 'Show the panel' : 'Hide the panel'}
            title={lab.panel() === undefined ? 'Show the panel' : 'Hide the panel'}
            onClick={lab.toggleInspector}
          >
            <Icon of={lab.panel() === undefined ? PanelRightOpen : PanelRightClose} />
          </button>
        </Show>
      </div>
    </section>
  );
}

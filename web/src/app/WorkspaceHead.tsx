// The head of the workspace: Positioner, view, layers, goal and disturbance buttons.

import { For, Show, type JSX } from 'solid-js';
import { CommandButton } from '../lab/CommandButton';
import { LayerMenu } from './LayerMenu';
import type { MapLayer } from '../plan/layer';
import { VIEW_MODES, type ViewMode } from './viewMode';
import type { Lab } from '../lab/slices';
import './WorkspaceHead.css';
import { addressOf, pathOf } from '../net/base';
import { SmallButton } from '../ui/SmallButton';

/** Radio buttons, so that arrow keys switch between them. */
function ViewSwitch(props: {
  mode: ViewMode;
  /** Fog and camera have no 3-D view. */
  isFixed: boolean;
  onMode: (mode: ViewMode) => void;
}): JSX.Element {
  return (
    <fieldset class="view-switch" role="radiogroup" aria-label="View">
      <For each={VIEW_MODES}>
        {([id, label]) => (
          <label>
            <input
              type="radio"
              name="workspace-view"
              checked={props.mode === id}
              disabled={props.isFixed}
              onChange={() => {
                props.onMode(id);
              }}
            />
            {label}
          </label>
        )}
      </For>
    </fieldset>
  );
}

export function WorkspaceHead(props: {
  lab: Lab;
  mode: ViewMode;
  onMode: (mode: ViewMode) => void;
  layers: readonly MapLayer[];
  disturbId: string;
  disturbing: boolean;
  onDisturbing: (on: boolean) => void;
  /** The next click on the workspace sets the goal. */
  onPickGoal: () => void;
}): JSX.Element {
  const { lab } = props;
  const hasArm = (): boolean => lab.scene()?.positioner !== 'planar_stage';
  return (
    <header class="panel-head">
      <h2>
        Workspace
        <Show when={!hasArm()}>
          <span class="remark" data-testid="positioner">
            Planar stage, no arm
          </span>
        </Show>
      </h2>
      <div class="buttons">
        <a
          class="button small"
          // The demonstration returns to this page.
          href={`${addressOf('/demo')}#${pathOf(window.location.pathname)}`}
          title="A demonstration that runs by itself. F11 gives it the whole screen, Esc returns."
        >
          Present
        </a>
        <ViewSwitch
          mode={lab.sight() === 'all' ? props.mode : 'plan'}
          isFixed={lab.sight() !== 'all'}
          onMode={props.onMode}
        />
        <LayerMenu lab={lab} layers={props.layers} />
        <Show
          when={lab.steering.isActive() && !lab.state()?.goal_m}
          fallback={
            <CommandButton
              lab={lab}
              at="workspace"
              class="small"
              disabled={!lab.state()?.goal_m}
              command={() => ({ type: 'clear_goal' })}
            >
              Clear goal
            </CommandButton>
          }
        >
          {/* A press steers here, so that a click cannot set the goal. */}
          <SmallButton onClick={props.onPickGoal}>Set goal</SmallButton>
        </Show>
        <SmallButton
          aria-expanded={props.disturbing}
          aria-controls={props.disturbId}
          disabled={!lab.canOperate()}
          onClick={() => {
            props.onDisturbing(!props.disturbing);
          }}
        >
          Disturb
        </SmallButton>
      </div>
    </header>
  );
}

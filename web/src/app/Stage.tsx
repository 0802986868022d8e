// The stage: the map or the 3-D view, with a band above and below it. A click sets the goal; dragging the bead disturbs it.

import { Match, Show, Switch, createEffect, createMemo, untrack, type JSX } from 'solid-js';
import { CircleQuestionMark, Maximize } from 'lucide';
import { StageBar } from '../features/challenge/StageBar';
import { CameraView } from '../features/steer/CameraView';
import { TipBar } from '../features/tips/TipBar';
import { CommandButton } from '../lab/CommandButton';
import { insidePolygon } from '../lab/geometry';
import type { Lab } from '../lab/slices';
import type { LiveLayer } from '../plan/layer';
import type { Interaction } from '../plan/interaction';
import type { ViewPicture } from '../plan/viewPicture';
import { MapView } from '../scene/MapView';
import { fixed } from '../ui/format';
import { isPhone, isUpright } from '../ui/windowSize';
import { Icon } from '../ui/Icon';
import { ScaleBar } from '../ui/ScaleBar';
import { endWords } from '../words/facts';
import { Counters } from './Counters';
import { WorkspaceHint } from './WorkspaceHint';
import type { ViewMode } from './viewMode';
import './Stage.css';

const HELP_ID = 'workspace-help';
/** Of the height of the 3-D picture, for the band below it. */
const BAND_SHARE = 0.09;

export function Stage(props: {
  lab: Lab;
  interaction: Interaction;
  layers: readonly LiveLayer[];
  mode: ViewMode;
  onMode: (mode: ViewMode) => void;
  onPicture: (picture: ViewPicture | undefined) => void;
  /** In place of the counters above the map. */
  notice: JSX.Element;
  /** In the band below the map. */
  children: JSX.Element;
}): JSX.Element {
  const { lab, interaction } = props;
  let stage!: HTMLElement;

  const readout = createMemo(() => {
    const scene = lab.scene();
    const at = interaction.at();
    if (!at || !scene) return undefined;
    // In fog the page tells no walls.
    if (lab.sight() !== 'all') return { at, wall: false };
    const moved = lab.movedWalls();
    const wall = moved ? moved.covers(at) : scene.walls.some((one) => insidePolygon(one, at));
    return { at, wall };
  });
  const spoken = createMemo(() => {
    const at = interaction.cursor();
    return interaction.focused() && at ? `x ${fixed(at[0], 3)}, y ${fixed(at[1], 3)} metres` : '';
  });
  const stale = (): string | undefined => {
    const ended = lab.ended();
    if (ended !== undefined) return `${endWords(ended)} Reload the page to restart it.`;
    return lab.connection().kind === 'live'
      ? undefined
      : 'No connection. This is the last received state.';
  };
  // The 3-D view has no fog.
  const isScene = (): boolean => lab.sight() === 'all' && props.mode === 'scene';
  /** On a phone a panel hides the lower half of the map. */
  const isLifted = createMemo(() => {
    const [map, bead_m] = [interaction.view(), lab.state()?.bead_m];
    if (!isPhone() || lab.panel() === undefined || isScene() || !map || !bead_m) return false;
    const at = map.toPx([bead_m[0], bead_m[1]])?.[isUpright() ? 0 : 1];
    return at !== undefined && at > 0.4 * stage.clientHeight;
  });
  createEffect(() => {
    const { kind } = interaction.act();
    if (isPhone() && (kind === 'held' || kind === 'steering') && untrack(lab.panel))
      lab.closePanel();
  });
  const surfaceProps = {
    lab,
    interaction,
    layers: props.layers,
    helpId: HELP_ID,
    onPicture: (picture: ViewPicture | undefined) => {
      props.onPicture(picture);
    },
  };

  return (
    <main
      ref={stage}
      class="stage"
      data-mode={isScene() ? 'scene' : 'plan'}
      data-fills={lab.fills()}
    >
      <div class="map-box" classList={{ lifted: isLifted() }}>
        <Show
          when={lab.sight() === 'camera'}
          fallback={
            <MapView
              {...surfaceProps}
              mode={isScene() ? 'scene' : 'plan'}
              isTurned={isUpright()}
              below={BAND_SHARE}
              onPlan={() => {
                props.onMode('plan');
              }}
            />
          }
        >
          <CameraView {...surfaceProps} notices={lab} />
        </Show>
        <Show when={lab.state() && stale()}>{(reason) => <p class="veil">{reason()}</p>}</Show>
      </div>
      <div class="band over">
        {props.notice}
        <Show when={!isPhone() && lab.contest.attempt()} fallback={<Counters lab={lab} />}>
          <StageBar
            lab={lab}
            onStart={() => {
              stage.querySelector('canvas')?.focus({ preventScroll: true });
            }}
          />
        </Show>
      </div>
      <div class="band under">
        <Switch
          fallback={
            <p id={HELP_ID} class="stage-hint">
              <Show when={lab.hello()?.role !== 'viewer'}>
                <WorkspaceHint
                  steers={lab.steering.isActive()}
                  scene={isScene()}
                  press={interaction.press()}
                />
              </Show>
            </p>
          }
        >
          <Match when={interaction.picker.isPicking()}>
            <p class="picking" role="status">
              Pick a place: click it, or use the arrow keys and Enter. Esc cancels.
            </p>
          </Match>
        </Switch>
        {/* A lesson has its own task. */}
        <Show
          when={
            !interaction.picker.isPicking() && !lab.steering.isActive() && !lab.address.lesson()
          }
        >
          <TipBar lab={lab} scene={isScene()} />
        </Show>
        {props.children}
        {/* Without its goal an attempt at a challenge is over. */}
        <Show when={!lab.scene()?.challenge}>
          <Show
            when={lab.steering.isActive() && !lab.state()?.goal_m}
            fallback={
              <CommandButton
                lab={lab}
                at="workspace"
                class="ghost small"
                disabled={!lab.state()?.goal_m}
                command={() => ({ type: 'clear_goal' })}
              >
                Clear goal
              </CommandButton>
            }
          >
            {/* A press steers here, so that a click cannot set the goal. */}
            <button
              type="button"
              class="ghost small"
              onClick={() => {
                interaction.picker.start(interaction.setGoal);
              }}
            >
              Set goal
            </button>
          </Show>
        </Show>
        <output class="readout number" aria-live="off">
          <Show when={readout()} fallback={!isScene() && <ScaleBar />}>
            {(here) => (
              <>
                <Show when={here().wall}>
                  <span class="wall-hint">wall </span>
                </Show>
                x {fixed(here().at[0], 3)} y {fixed(here().at[1], 3)} m
              </>
            )}
          </Show>
        </output>
        <Show when={!isScene()}>
          <button type="button" class="ghost small fill" title="Fill (F)" onClick={lab.toggleFill}>
            <Icon of={Maximize} />
            Fill
          </button>
        </Show>
        <button
          type="button"
          class="ghost small"
          onClick={() => {
            lab.showPanel('layers');
          }}
        >
          <Icon of={CircleQuestionMark} />
          Key
        </button>
        <span class="visually-hidden" aria-live="polite">
          {spoken()}
        </span>
      </div>
    </main>
  );
}

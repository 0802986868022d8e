// The workspace in the plan view or the 3-D view. A click sets the goal; dragging the bead disturbs it.

import { For, Show, createMemo, createSignal } from 'solid-js';
import type { JSX } from 'solid-js';
import { fixed } from '../ui/format';
import { PlaceNotice } from '../lab/PlaceNotice';
import { StageBar } from '../features/challenge/StageBar';
import { DisturbBar } from '../features/disturb/DisturbBar';
import { MarksLegend } from '../features/marks/MarksLegend';
import { FailureCard } from '../features/failure/FailureCard';
import { CameraView } from '../features/steer/CameraView';
import { TipBar } from '../features/tips/TipBar';
import { createChoice } from '../ui/storage';
import { MapView } from '../scene/MapView';
import { createLayers } from '../plan/layer';
import type { ViewPicture } from '../plan/viewPicture';
import { MAP_LAYERS } from './layers';
import { createInteraction } from '../plan/interaction';
import { WorkspaceHead } from './WorkspaceHead';
import { WorkspaceHint } from './WorkspaceHint';
import { insidePolygon } from '../lab/geometry';
import type { Lab } from '../lab/slices';
import { endWords } from '../words/facts';
import './WorkspacePanel.css';

const HELP_ID = 'workspace-help';

export function WorkspacePanel(props: {
  lab: Lab;
  onPicture: (picture: ViewPicture | undefined) => void;
  /** Over the view. */
  children: JSX.Element;
}): JSX.Element {
  const { lab } = props;
  let stage!: HTMLDivElement;
  const [mode, choose] = createChoice('view', ['plan', 'scene']);
  const [disturbing, setDisturbing] = createSignal(false);
  const interaction = createInteraction(lab);
  const layers = createLayers(MAP_LAYERS, lab);
  /** Topmost layer first. */
  const menu = [...layers].reverse();

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
    if (ended !== undefined) {
      return `${endWords(ended)} Reload the page to restart it.`;
    }
    return lab.connection().kind === 'live'
      ? undefined
      : 'No connection. This is the last received state.';
  };
  const onPicture = (picture: ViewPicture | undefined): void => {
    props.onPicture(picture);
  };
  const surfaceProps = { lab, interaction, layers, helpId: HELP_ID, onPicture };

  return (
    <section class="panel workspace">
      <WorkspaceHead
        lab={lab}
        mode={mode()}
        onMode={choose}
        layers={menu}
        disturbId="disturb"
        disturbing={disturbing()}
        onDisturbing={setDisturbing}
        onPickGoal={() => {
          interaction.picker.start(interaction.setGoal);
        }}
      />
      <Show when={disturbing()}>
        <DisturbBar lab={lab} id="disturb" picker={interaction.picker} />
      </Show>
      <StageBar
        lab={lab}
        onStart={() => {
          stage.querySelector('canvas')?.focus({ preventScroll: true });
        }}
      />
      <div ref={stage} class="stage">
        <Show
          when={lab.sight() === 'camera'}
          fallback={
            <MapView
              {...surfaceProps}
              // The 3-D view has no fog.
              mode={lab.sight() === 'all' ? mode() : 'plan'}
              onPlan={() => {
                choose('plan');
              }}
            />
          }
        >
          <CameraView {...surfaceProps} notices={lab} />
        </Show>
        <Show when={lab.state() && stale()}>{(reason) => <p class="veil">{reason()}</p>}</Show>
        <Show when={!interaction.picker.isPicking() && !lab.steering.isActive()}>
          <TipBar lab={lab} scene={mode() === 'scene'} />
        </Show>
        <Show when={interaction.picker.isPicking()}>
          <p class="picking" role="status">
            Pick a place: click it, or use the arrow keys and Enter. Esc cancels.
          </p>
        </Show>
        {props.children}
        <FailureCard lab={lab} />
      </div>
      <For each={menu}>{(layer) => <Show when={layer.isShown()}>{layer.legend?.()}</Show>}</For>
      <footer class="panel-foot">
        {/* Not above the map, where it would cover the bead. */}
        <PlaceNotice lab={lab} place="workspace" />
        <p id={HELP_ID} class="hint">
          <WorkspaceHint steers={lab.steering.isActive()} scene={mode() === 'scene'} />
        </p>
        <Show when={mode() === 'plan'}>
          <MarksLegend isShown={(id) => lab.layers().has(id)} />
        </Show>
        <output class="readout" aria-live="off">
          <Show when={readout()} fallback="x –   y –">
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
        <span class="visually-hidden" aria-live="polite">
          {spoken()}
        </span>
      </footer>
    </section>
  );
}

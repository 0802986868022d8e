// The plan view: click places the goal, dragging the bead is the disturbance.

import { Show, createEffect, createMemo, createSignal, onCleanup, onMount } from 'solid-js';
import type { JSX } from 'solid-js';
import { createAnswer } from '../answers';
import { fixed } from '../format';
import type { Lab } from '../lab';
import { NoticeBar } from '../panels/NoticeBar';
import type { WorkspaceMap, WorkspaceQuery } from '../protocol.gen';
import type { Theme } from '../theme';
import { fitView, insidePolygon, worldFromPx, type Vec2, type View } from '../transform';
import { DisturbBar } from './DisturbBar';
import { createHeat } from './drawHeat';
import { wallPath } from './drawMap';
import { createPlan } from './drawPlan';
import { createSeen } from './drawSeen';
import { createValues } from './drawValue';
import { FlowLegend } from './FlowLegend';
import { createFlowLayer } from './flowLayer';
import { createGoal } from './goal';
import { createHand } from './hand';
import { workspaceQuery } from './heat';
import { HeatLegend } from './HeatLegend';
import { attachKeyboard } from './keyboard';
import { paint } from './paint';
import { createPalette } from '../palette';
import { GRAB_MOUSE_PX, attachPointer, type Pointing } from './pointer';
import { ValueLegend } from './ValueLegend';
import { createValueLayer } from './valueLayer';
import { WorkspaceHead } from './WorkspaceHead';

/** Room for the numbers of the axes. */
const INSETS = { left: 46, right: 12, top: 12, bottom: 24 };

interface Size {
  readonly width: number;
  readonly height: number;
}

export function WorkspacePanel(props: { lab: Lab; theme: () => Theme }): JSX.Element {
  const { lab } = props;
  let canvas!: HTMLCanvasElement;
  const [size, setSize] = createSignal<Size>({ width: 0, height: 0 });
  const [pointing, setPointing] = createSignal<Pointing>({ at: undefined, nearBead: false });
  const [cursor, setCursor] = createSignal<Vec2>();
  const [disturbing, setDisturbing] = createSignal(false);
  const [focused, setFocused] = createSignal(false);
  const { layers } = lab;

  const view = createMemo<View | undefined>(() => {
    const scene = lab.scene();
    const { width, height } = size();
    return scene && width > 0 ? fitView(scene.workspace, width, height, INSETS) : undefined;
  });
  const walls = createMemo(() => {
    const now = view();
    const scene = lab.scene();
    return now && scene ? wallPath(scene.walls, now) : undefined;
  });
  const palette = createPalette(() => props.theme());
  const hand = createHand(lab, view);

  const heatQuestion = createMemo<WorkspaceQuery | undefined>(() => {
    const scene = lab.scene();
    const parameters = lab.tuning();
    if (!scene || !parameters || !layers().has('singularity')) return undefined;
    return workspaceQuery(scene, parameters);
  });
  const heatAnswer = createAnswer<WorkspaceQuery, WorkspaceMap>('/api/kinematics/workspace', () =>
    lab.link().kind === 'live' ? heatQuestion() : undefined,
  );
  const heat = createMemo(() => {
    const map = heatAnswer().data;
    return map && createHeat(map, palette());
  });

  const seen = createMemo(() => {
    const message = layers().has('seen') ? lab.seen() : undefined;
    return message && createSeen(message, palette());
  });

  const plan = createMemo(() => {
    const layer = lab.overlay()?.plan;
    const now = view();
    const isShown = layers().has('plan') || layers().has('obstacles');
    return layer && now && isShown ? createPlan(layer, now) : undefined;
  });

  const goal = createGoal(lab);
  const showsFlow = createMemo(() => layers().has('flow'));
  const flowLayer = createFlowLayer(lab, goal, showsFlow);

  const showsValue = createMemo(() => layers().has('value'));
  const valueLayer = createValueLayer(lab, goal, showsValue);
  const values = createMemo(() => {
    const map = valueLayer.map();
    const now = view();
    return map && now ? createValues(map, palette(), now) : undefined;
  });

  const ghosts = createMemo(() => {
    const comparison = lab.ghosts.comparison();
    return comparison && layers().has('ghosts')
      ? { comparison, tick: lab.ghosts.tick() }
      : undefined;
  });

  const readout = createMemo(() => {
    const now = view();
    const scene = lab.scene();
    const px = pointing().at;
    const at = px && now ? worldFromPx(now, px) : focused() ? cursor() : undefined;
    if (!at || !scene) return undefined;
    return { at, wall: scene.walls.some((wall) => insidePolygon(wall, at)) };
  });
  const spoken = createMemo(() => {
    const at = cursor();
    return focused() && at ? `x ${fixed(at[0], 3)}, y ${fixed(at[1], 3)} metres` : '';
  });

  onMount(() => {
    const observer = new ResizeObserver(() => {
      setSize({ width: canvas.clientWidth, height: canvas.clientHeight });
    });
    observer.observe(canvas);
    onCleanup(() => {
      observer.disconnect();
    });
    attachPointer(canvas, lab, hand, view, setPointing);
    attachKeyboard(canvas, lab, hand, view, cursor, setCursor);
  });

  createEffect(() => {
    // A lost socket has let go of the bead on the server; a lost role may not hold it.
    if (!lab.canOperate()) hand.dispatch({ type: 'cancel' });
  });

  createEffect(() => {
    const scene = lab.scene();
    const now = view();
    const wallsNow = walls();
    if (!scene || !now || !wallsNow) return;
    paint(canvas, size(), {
      view: now,
      palette: palette(),
      scene,
      walls: wallsNow,
      state: lab.state(),
      overlay: lab.overlay(),
      heat: heatQuestion() && heat(),
      values: values(),
      seen: seen(),
      plan: plan(),
      flow: flowLayer.flow(),
      ghosts: ghosts(),
      history: lab.history,
      layers: layers(),
      drag: hand.drag(),
      grabRadiusPx: pointing().nearBead ? GRAB_MOUSE_PX : undefined,
      cursor: focused() ? cursor() : undefined,
    });
  });

  // The geometry on the screen, for tests and for other tools that read the page.
  createEffect(() => {
    const now = view();
    if (!now) return;
    canvas.dataset.pxPerM = String(now.pxPerM);
    canvas.dataset.originX = String(now.originX);
    canvas.dataset.originY = String(now.originY);
  });
  createEffect(() => {
    const state = lab.state();
    if (!state) return;
    canvas.dataset.tick = String(state.tick);
    canvas.dataset.bead = state.bead_m.slice(0, 2).join(',');
    canvas.dataset.tool = state.tool_m.slice(0, 2).join(',');
    canvas.dataset.goal = state.goal_m?.slice(0, 2).join(',') ?? '';
  });

  const stale = (): string | undefined => {
    const ended = lab.ended();
    if (ended !== undefined) return `The session has ended: ${ended}`;
    return lab.link().kind === 'live'
      ? undefined
      : 'No connection: this is the last state received.';
  };
  const cursorName = (): string => {
    if (hand.drag().kind === 'held') return 'holding';
    return pointing().nearBead ? 'near-bead' : 'free';
  };

  return (
    <section class="panel workspace">
      <WorkspaceHead
        lab={lab}
        layers={layers()}
        onLayer={(layer, on) => {
          lab.showLayer(layer, on);
        }}
        disturbId="disturb"
        disturbing={disturbing()}
        onDisturbing={setDisturbing}
      />
      <Show when={disturbing() && lab.canOperate()}>
        <DisturbBar lab={lab} id="disturb" />
      </Show>
      <div class="stage">
        <canvas
          ref={canvas}
          class="workspace-canvas"
          tabindex="0"
          role="application"
          aria-label="Workspace"
          aria-describedby="workspace-help"
          data-cursor={cursorName()}
          onFocus={() => {
            setFocused(true);
          }}
          onBlur={() => {
            setFocused(false);
          }}
        />
        <Show when={lab.state() && stale()}>{(reason) => <p class="veil">{reason()}</p>}</Show>
        <NoticeBar lab={lab} place="workspace" />
      </div>
      <Show when={heatQuestion()}>
        <HeatLegend answer={heatAnswer()} />
      </Show>
      <Show when={showsFlow() && lab.scene()}>
        {(scene) => (
          <FlowLegend
            answer={flowLayer.answer()}
            flow={flowLayer.flow()}
            hasGoal={goal() !== undefined}
            law={scene().parameters.attractor_law}
          />
        )}
      </Show>
      <Show when={showsValue()}>
        <ValueLegend
          map={valueLayer.map()}
          error={valueLayer.error()}
          hasGoal={goal() !== undefined}
        />
      </Show>
      <footer class="panel-foot">
        <p id="workspace-help" class="hint">
          Click: goal · drag the bead: disturb, Shift lifts it over walls · keys: arrows, Enter, D
        </p>
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

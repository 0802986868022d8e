// The 3-D view of the workspace. Its drawing code is loaded when it is opened for the first time.

import {
  For,
  Show,
  createEffect,
  createMemo,
  createSignal,
  on,
  onCleanup,
  untrack,
  type JSX,
} from 'solid-js';
import type { PlanPicture } from './flight';
import type { ViewpointName } from './viewpoints';
import type { Colours, SceneView } from './SceneView';
import type { InScene, LoadedLayer } from './sceneLayer';
import { createBaseMap } from '../plan/baseMap';
import type { Surface } from '../plan/interaction';
import { type LiveLayer, type MapLayer, shownParts } from '../plan/layer';
import { createFloorPicture, type FloorPicture, repaintFloor } from '../plan/floorPicture';
import { pullOf } from '../plan/paint';
import type { SurfaceProps } from '../plan/PlanView';
import type { Size } from '../ui/size';
import { ViewCanvas } from '../plan/ViewCanvas';
import { reasonText } from '../net/problem';
import { prefersLessMotion } from '../ui/motion';
import { palette } from '../ui/palette';
import { theme } from '../ui/theme';
import type { TableView } from '../lab/geometry';
import { drawsSlowly } from './graphics';
import './scene.css';

const VIEWPOINTS: readonly ViewpointName[] = ['Home', 'Top', 'Front', 'Side'];

async function loadObjects(layers: readonly (MapLayer & InScene)[]): Promise<LoadedLayer[]> {
  const all = await Promise.all(
    layers.map(async ({ id, sceneObject }) => {
      const create = await sceneObject?.();
      return create && { id, create };
    }),
  );
  // The last one is the lowest on the floor.
  return all.filter((one) => one !== undefined).reverse();
}

export function ScenePanel(
  props: SurfaceProps & {
    layers: readonly LiveLayer<MapLayer & InScene>[];
    onPlan: () => void;
    /** The pointer does not turn the view. */
    isFixed?: boolean;
    /** Bead, trails and goal can be recognised from far away. */
    isBold?: boolean;
    /** Shift of the picture to the right, as a share of its width: on the left there is text. */
    shift?: number;
    /** Share of its height that stays free below, at the viewpoints. */
    below?: number;
    /** The picture of the plan view, if the user comes from there. */
    plan?: PlanPicture | undefined;
    /** The camera flies to that picture. */
    isLeaving?: boolean;
    /** Called when it is there. */
    onLeft?: () => void;
    /** Called when the view cannot be shown. */
    onProblem?: () => void;
  },
): JSX.Element {
  const { lab, interaction, layers } = props;
  const { act, reachPx, focused, cursor } = interaction;
  const [drawing, setDrawing] = createSignal<SceneView>();
  const [problem, setProblem] = createSignal<string>();
  const [size, setSize] = createSignal<Size>({ width: 0, height: 0 });
  const [viewpoint, setViewpoint] = createSignal<ViewpointName | undefined>('Home');
  const wantsLessMotion = prefersLessMotion();
  const colours = (): Colours => ({ palette: palette(), isDark: theme() === 'dark' });
  let isGone = false;

  const open = async (canvas: HTMLCanvasElement): Promise<void> => {
    const [{ SceneView }, inScene] = await Promise.all([
      import('./SceneView'),
      loadObjects(layers),
    ]).catch(() => {
      throw new Error('The 3-D view could not be loaded from the server.');
    });
    if (isGone) return;
    const options = {
      colours: untrack(colours),
      layers: inScene,
      onView: (view: TableView) => {
        interaction.setView(view);
        setViewpoint(drawing()?.orbit.viewpoint);
      },
      isBold: props.isBold ?? false,
      rest: { shift: props.shift ?? 0, below: props.below ?? 0 },
      isSlow: drawsSlowly(),
      wantsLessMotion,
      plan: props.plan,
    };
    setDrawing(new SceneView(canvas, options));
  };
  const start = (canvas: HTMLCanvasElement): void => {
    open(canvas).catch((reason: unknown) => {
      setProblem(reasonText(reason));
      props.onProblem?.();
    });
  };
  /** A pointer that takes the bead does not move the view. */
  const isHeld = (): boolean => {
    const now = act();
    return now.kind === 'held' ? now.by !== 'keyboard' : now.kind === 'pressed' && now.onBead;
  };
  const surface: Surface = {
    motion: () => (props.isFixed || isHeld() ? undefined : drawing()?.orbit),
    key: (key) => drawing()?.orbit.key(key) ?? false,
    turned: (arrow) => drawing()?.orbit.turned(arrow) ?? arrow,
  };
  onCleanup(() => {
    isGone = true;
    drawing()?.dispose();
  });

  createEffect(() => {
    const { width, height } = size();
    drawing()?.resize(width, height);
  });
  createEffect(
    on(
      () => props.whole?.(),
      () => drawing()?.orbit.take('Home'),
      { defer: true },
    ),
  );
  createEffect(() => drawing()?.recolor(colours()));
  createEffect(() => {
    const scene = lab.scene();
    if (scene) drawing()?.show(scene);
  });
  createEffect(() => {
    if (!props.isLeaving) return;
    const [view, plan] = untrack(() => [drawing(), props.plan]);
    const left = (): void => props.onLeft?.();
    if (view && plan) view.orbit.leave(plan, left);
    else left();
  });

  const picture = createMemo<FloorPicture | undefined>(
    () => {
      const workspace = lab.scene()?.workspace;
      return workspace && createFloorPicture(workspace);
    },
    undefined,
    // Keep the picture of the same table.
    { equals: (a, b) => JSON.stringify(a?.workspace) === JSON.stringify(b?.workspace) },
  );
  const baseMap = createBaseMap(lab, layers, () => picture()?.view);
  createEffect(() => {
    const [onto, now] = [picture(), baseMap()];
    const view = drawing();
    if (!onto || !now || !view) return;
    repaintFloor(onto, now);
    view.lay(onto);
  });

  createEffect(() =>
    drawing()?.hang(shownParts(layers, 'underTool').map(({ drawing }) => drawing)),
  );

  const pull = createMemo(() => {
    const [scene, state] = [lab.scene(), lab.state()];
    return scene && state && pullOf(act(), state, scene);
  });
  createEffect(() => {
    const state = lab.state();
    if (!state) return;
    drawing()?.update({
      state,
      history: lab.history,
      walls: lab.movedWalls(),
      layers: lab.layers(),
      pull: pull(),
      nearBead: reachPx() !== undefined,
      cursor: focused() ? cursor() : undefined,
    });
  });

  const label = createMemo(() => {
    const now = pull();
    const at = now && interaction.view()?.toPx(now.hand_m);
    if (!at) return undefined;
    // To the left of the pointer if there is no space on the right.
    const side = at[0] > 0.7 * size().width ? 'left' : 'right';
    return { text: now.words, at, side };
  });

  return (
    <>
      <ViewCanvas
        lab={lab}
        interaction={interaction}
        label="Scene"
        class="scene-canvas"
        helpId={props.helpId}
        surface={surface}
        onCanvas={start}
        onSize={setSize}
        // Its pixels do not stay: they are valid only until the browser shows the frame.
        draw={drawing()?.draw}
        onPicture={props.onPicture}
      />
      <Show when={label()}>
        {(now) => (
          <span
            class="spring-label number"
            data-side={now().side}
            style={{ transform: `translate(${now().at[0]}px, ${now().at[1]}px)` }}
          >
            <span>{now().text}</span>
          </span>
        )}
      </Show>
      <Show
        when={drawing()}
        fallback={
          <div class="scene-message" role="status">
            <Show when={problem()} fallback={<p>Loading the 3-D view …</p>}>
              {(text) => (
                <>
                  <p>{text()}</p>
                  <p>The plan view shows the same workspace and has all functions.</p>
                  <button type="button" onClick={() => props.onPlan()}>
                    Back to the plan view
                  </button>
                </>
              )}
            </Show>
          </div>
        }
      >
        {(view) => (
          <div class="looks" role="group" aria-label="Viewpoint">
            <For each={VIEWPOINTS}>
              {(name) => (
                <button
                  type="button"
                  aria-pressed={viewpoint() === name}
                  onClick={() => view().orbit.take(name)}
                >
                  {name}
                </button>
              )}
            </For>
          </div>
        )}
      </Show>
      <Show when={drawing() && drawsSlowly()}>
        <p class="scene-slow">Slow here: this browser draws without a graphics card.</p>
      </Show>
    </>
  );
}

// The workspace from above.

import {
  Show,
  createEffect,
  createMemo,
  createSignal,
  on,
  untrack,
  type Accessor,
  type JSX,
} from 'solid-js';
import { fitView, pxFromWorld, pxRect, tableViewOf, type View } from './transform';
import { createBaseMap } from './baseMap';
import { cornerPx, framed } from './tray';
import { fogImage } from './fog';
import { type Draw, type LiveLayer, type MovingPicture, shownParts, type UnderTool } from './layer';
import { type Base, createPainter, type Picture } from './paint';
import type { Interaction } from './interaction';
import type { Size } from '../ui/size';
import { ViewCanvas } from './ViewCanvas';
import type { ViewPicture } from './viewPicture';
import { type Frame, WHOLE, type Zoom, zoomedView } from './zoom';
import { yieldToPage, zooming } from './zooming';
import './plan.css';
import type { ByHand, Layers, Pictures, Session, Trial, Walls } from '../lab/slices';
import { palette } from '../ui/palette';

export interface SurfaceProps {
  readonly lab: Session & Trial & Layers & Pictures & ByHand & Walls;
  readonly interaction: Interaction;
  readonly layers: readonly LiveLayer[];
  readonly helpId: string;
  /** The whole workspace is shown again when this changes. */
  readonly whole?: Accessor<number>;
  /** Shows the map turned by 90°, clockwise. */
  readonly isTurned?: boolean;
  /** Called with the view when it can be drawn, and with nothing when it closes. */
  readonly onPicture?: (picture: ViewPicture | undefined) => void;
}

const atTool =
  ({ draw }: UnderTool): Draw<MovingPicture> =>
  (ctx, { view, palette, state }) => {
    const [originX, originY] = pxFromWorld(view, [state.tool_m[0], state.tool_m[1]]);
    draw(ctx, { ...view, originX, originY }, palette);
  };

export function PlanView(props: SurfaceProps): JSX.Element {
  const { lab, interaction, layers } = props;
  const { act, reachPx, focused, cursor } = interaction;
  const [canvas, setCanvas] = createSignal<HTMLCanvasElement>();
  const [size, setSize] = createSignal<Size>({ width: 0, height: 0 });

  const [zoom, setZoom] = createSignal<Zoom>(WHOLE);

  const frame = createMemo<Frame | undefined>(() => {
    const workspace = lab.scene()?.workspace;
    const { width, height } = size();
    if (!workspace || width * height === 0) return undefined;
    return { width, height, workspace, fit: fitView(framed(workspace), width, height) };
  });
  const view = createMemo<View | undefined>(() => {
    const now = frame();
    return now && { ...zoomedView(now, zoom()), ...(props.isTurned && { isTurned: true }) };
  });
  const trayRect = createMemo((): Record<string, string> | undefined => {
    const [now, workspace] = [view(), lab.scene()?.workspace];
    if (!now || !workspace) return undefined;
    const sides = pxRect(now, framed(workspace)).map((side) => `${String(side)}px`);
    const [left = '', top = '', width = '', height = ''] = sides;
    const corner = `${String(cornerPx(workspace, now))}px`;
    return { left, top, width, height, 'border-radius': corner };
  });
  const map = createMemo(() => lab.scene()?.map);
  createEffect(on([map, () => props.whole?.()], () => setZoom(WHOLE), { defer: true }));
  createEffect(() => {
    const now = view();
    interaction.setView(now && tableViewOf(now));
  });
  const baseMap = createBaseMap(lab, layers, view, lab.movedWalls);

  const moving = createMemo(() => [
    ...shownParts(layers, 'underTool').map(({ drawing }) => atTool(drawing)),
    ...shownParts(layers, 'moving').map(({ drawing }) => drawing),
  ]);
  const fog = createMemo(() =>
    lab.sight() === 'all' ? undefined : fogImage(lab.obstacleMap(), palette()),
  );
  const base = createMemo<Base | undefined>(() => {
    const map = baseMap();
    return map && { ...map, fog: fog() };
  });
  const canGrab = (): boolean => lab.canOperate() && !lab.steering.isActive();
  const picture = createMemo<Picture | undefined>(() => {
    const baseNow = base();
    return (
      baseNow && {
        base: baseNow,
        moving: moving(),
        state: lab.state(),
        history: lab.history,
        act: act(),
        grab: canGrab() ? { isNear: reachPx() !== undefined } : undefined,
        cursor: focused() && !lab.steering.isActive() ? cursor() : undefined,
        steer_m: lab.steering.target() ?? lab.state()?.steer_m ?? undefined,
      }
    );
  });
  const paint = createPainter();
  createEffect(() => {
    const [now, onto] = [picture(), canvas()];
    if (now && onto) paint(onto, size(), now);
  });
  const draw = (ratio: number): HTMLCanvasElement | undefined => {
    const [now, own] = untrack(() => [picture(), canvas()]);
    if (!now) return undefined;
    if (ratio === window.devicePixelRatio) return own;
    const onto = document.createElement('canvas');
    createPainter()(onto, untrack(size), now, ratio);
    return onto;
  };

  // The geometry on the screen, for tests and other tools that read the page.
  createEffect(() => {
    const onto = canvas();
    if (!onto) return;
    delete onto.dataset.isTurned;
    Object.assign(onto.dataset, view());
  });

  return (
    <>
      <div class="plan" classList={{ turned: props.isTurned ?? false }}>
        <Show when={zoom() === WHOLE && trayRect()}>
          {(rect) => <div class="tray" style={rect()} aria-hidden="true" />}
        </Show>
        <ViewCanvas
          lab={lab}
          interaction={interaction}
          label="Workspace"
          class="plan-canvas"
          helpId={props.helpId}
          surface={{
            ...zooming(canvas, frame, zoom, setZoom),
            turned: ([x, y]) => (props.isTurned ? [-y, x] : [x, y]),
            isTurned: () => props.isTurned ?? false,
          }}
          onCanvas={(onto) => {
            setCanvas(onto);
            yieldToPage(onto);
          }}
          onSize={setSize}
          draw={draw}
          onPicture={props.onPicture}
        />
      </div>
      <Show when={zoom() !== WHOLE}>
        <button
          type="button"
          class="small plan-fit"
          title="Shows the whole workspace (Home)"
          onClick={() => {
            setZoom(WHOLE);
            canvas()?.focus();
          }}
        >
          Fit
        </button>
      </Show>
    </>
  );
}

// The workspace from above.

import { createEffect, createMemo, createSignal, type Accessor, type JSX } from 'solid-js';
import type { Palette } from '../ui/palette';
import { fitView, tableViewOf, type View } from './transform';
import { createBaseMap } from './baseMap';
import type { LiveLayer } from './layer';
import { paint } from './paint';
import type { Interaction } from './interaction';
import { type Size, ViewCanvas } from './ViewCanvas';
import type { Layers, Trial } from '../lab/slices';

/** Space for the numbers of the axes, in pixels. */
const INSETS = { left: 46, right: 12, top: 12, bottom: 24 };

export interface SurfaceProps {
  readonly lab: Trial & Layers;
  readonly interaction: Interaction;
  readonly layers: readonly LiveLayer[];
  readonly palette: Accessor<Palette>;
  readonly helpId: string;
}

export function PlanView(props: SurfaceProps): JSX.Element {
  const { lab, interaction, layers, palette } = props;
  const { hand, reachPx, focused, cursor } = interaction;
  const [canvas, setCanvas] = createSignal<HTMLCanvasElement>();
  const [size, setSize] = createSignal<Size>({ width: 0, height: 0 });

  const view = createMemo<View | undefined>(() => {
    const scene = lab.scene();
    const { width, height } = size();
    return scene && width > 0 ? fitView(scene.workspace, width, height, INSETS) : undefined;
  });
  createEffect(() => {
    const now = view();
    interaction.setView(now && tableViewOf(now));
  });
  const baseMap = createBaseMap(lab, layers, palette, view);

  const moving = createMemo(() =>
    layers.flatMap((layer) => {
      const draw = layer.isShown() ? layer.moving?.() : undefined;
      return draw ? [draw] : [];
    }),
  );
  createEffect(() => {
    const mapNow = baseMap();
    const onto = canvas();
    if (!mapNow || !onto) return;
    paint(onto, size(), {
      map: mapNow,
      moving: moving(),
      state: lab.state(),
      history: lab.history,
      drag: hand.drag(),
      grabRadiusPx: reachPx(),
      cursor: focused() ? cursor() : undefined,
    });
  });

  // The geometry on the screen, for tests and other tools that read the page.
  createEffect(() => {
    const now = view();
    const onto = canvas();
    if (!now || !onto) return;
    onto.dataset.pxPerM = String(now.pxPerM);
    onto.dataset.originX = String(now.originX);
    onto.dataset.originY = String(now.originY);
  });

  return (
    <ViewCanvas
      lab={lab}
      interaction={interaction}
      label="Workspace"
      class="plan-canvas"
      helpId={props.helpId}
      onCanvas={setCanvas}
      onSize={setSize}
    />
  );
}

// The locus: the part of the figure in the plane, with its caption.

import { createEffect, createMemo, createSignal, onMount, type JSX } from 'solid-js';
import { fixed } from '../../ui/format';
import { onSize } from '../../ui/size';
import { drawBorder, drawFloor } from '../../plan/drawMap';
import { wallPath } from '../../plan/tray';
import { contextOf } from '../../plan/sheet';
import { fitView, type View } from '../../plan/transform';
import { drawLocus, placesAt, sampleAt } from './drawLocus';
import type { Figure } from './figure';
import { LOCUS_LETTER } from './parts';
import type { Sample } from './sample';
import { TERMS } from '../../lab/terms';
import type { Vec2 } from '../../lab/geometry';
import { shownWalls } from '../../lab/sight';
import type { ByHand, Trial } from '../../lab/slices';
import { palette } from '../../ui/palette';
import '../../ui/plot.css';

const INSETS = { left: 3, right: 3, top: 3, bottom: 3 };
/** How near to the line a pointer has to be to read it. */
const REACH_PX = 24;

export function LocusPlot(props: {
  lab: Trial & ByHand;
  figure: Figure;
  sample: Sample | undefined;
}): JSX.Element {
  const { lab, figure } = props;
  let canvas!: HTMLCanvasElement;
  const [size, setSize] = createSignal({ width: 0, height: 0 });
  const view = createMemo<View | undefined>(() => {
    const scene = lab.scene();
    const { width, height } = size();
    return scene && width > 0 ? fitView(scene.workspace, width, height, INSETS) : undefined;
  });
  const walls = createMemo(() => {
    const now = view();
    return now && wallPath(shownWalls(lab), now);
  });
  const marked = createMemo(() => figure.indexIn(props.sample));
  const words = (): string => {
    const [{ sample }, index] = [props, marked()];
    if (!sample || index === undefined) return '';
    const { tool, bead } = placesAt(sample, index);
    const place = ([x, y]: Vec2): string => `(${fixed(x, 2)}, ${fixed(y, 2)}) m`;
    return `Tool ${place(tool)}, bead ${place(bead)}`;
  };

  onMount(() => {
    onSize(canvas, setSize);
    createEffect(() => {
      const [now, workspace, outlines] = [view(), lab.scene()?.workspace, walls()];
      const [{ sample }, colours] = [props, palette()];
      const ctx = contextOf(canvas, size());
      if (!now || !workspace || !outlines || !sample || !ctx) return;
      drawFloor(ctx, workspace, now, colours);
      const goal_m = lab.goal();
      drawLocus(ctx, {
        view: now,
        palette: colours,
        walls: outlines,
        sample,
        goal_m,
        marked: marked(),
      });
      drawBorder(ctx, workspace, now, colours);
    });
  });

  const point = (event: PointerEvent): void => {
    const [now, { sample }] = [view(), props];
    if (!now || !sample) return;
    const index = sampleAt(sample, now, [event.offsetX, event.offsetY], REACH_PX);
    figure.point(index === undefined ? undefined : sample.columns.sim_time_s[index]);
  };

  return (
    <figure class="plot" data-part={LOCUS_LETTER}>
      <figcaption>
        <span class="letter">{LOCUS_LETTER}</span>
        <strong title={TERMS.locus}>Locus</strong>
        <span class="key" data-color="tool">
          tool
        </span>
        <span class="key" data-color="bead">
          bead
        </span>
        <span class="key cross">disturbed</span>
      </figcaption>
      <div class="plot-area">
        <canvas
          ref={canvas}
          class="locus"
          role="img"
          aria-label={`Path in the plane. ${words()}`}
          onPointerMove={point}
          onPointerLeave={() => {
            figure.point(undefined);
          }}
        />
      </div>
    </figure>
  );
}

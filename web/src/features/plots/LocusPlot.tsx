// The locus: the part of the figure in the plane, with its caption.

import { createEffect, createMemo, createSignal, on, onCleanup, onMount, type JSX } from 'solid-js';
import { fixed } from '../../ui/format';
import type { Palette } from '../../ui/palette';
import { fitView, type View } from '../../plan/transform';
import { wallPath } from '../../plan/drawMap';
import { drawLocus, placesAt, sampleAt } from './drawLocus';
import type { Figure } from './figure';
import { LOCUS_LETTER } from './parts';
import { nearestIndex } from './sample';
import { TERMS } from '../../lab/terms';
import type { Vec2 } from '../../lab/geometry';
import { shownWalls } from '../../lab/sight';
import type { ByHand, Trial } from '../../lab/slices';
import '../../ui/plot.css';

const INSETS = { left: 3, right: 3, top: 3, bottom: 3 };
/** How near to the line a pointer has to be to read it. */
const REACH_PX = 24;

export function LocusPlot(props: {
  lab: Trial & ByHand;
  figure: Figure;
  palette: () => Palette;
  onDraw: (draw: () => void) => void;
}): JSX.Element {
  const { lab, figure } = props;
  let canvas!: HTMLCanvasElement;
  const [size, setSize] = createSignal({ width: 0, height: 0 });
  const [words, setWords] = createSignal('');
  const view = createMemo<View | undefined>(() => {
    const scene = lab.scene();
    const { width, height } = size();
    return scene && width > 0 ? fitView(scene.workspace, width, height, INSETS) : undefined;
  });
  const walls = createMemo(() => {
    const now = view();
    return now && wallPath(shownWalls(lab), now);
  });

  const draw = (): void => {
    const now = view();
    const scene = lab.scene();
    const wallsNow = walls();
    const sample = figure.sample();
    const ctx = canvas.getContext('2d');
    if (!now || !scene || !wallsNow || !sample || !ctx) return;
    const { width, height } = size();
    const ratio = window.devicePixelRatio;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    ctx.scale(ratio, ratio);
    const palette = props.palette();
    const { x_min_m, x_max_m, y_min_m, y_max_m } = scene.workspace;
    const left = now.originX + x_min_m * now.pxPerM;
    const top = now.originY - y_max_m * now.pxPerM;
    ctx.fillStyle = palette.floor;
    ctx.fillRect(left, top, (x_max_m - x_min_m) * now.pxPerM, (y_max_m - y_min_m) * now.pxPerM);
    const goal_m = lab.state()?.goal_m;
    const marked = nearestIndex(sample.columns.sim_time_s, figure.pointed_s() ?? sample.at_s);
    drawLocus(ctx, {
      view: now,
      palette,
      walls: wallsNow,
      sample,
      goal_m: goal_m ? [goal_m[0], goal_m[1]] : undefined,
      marked,
    });
    ctx.strokeStyle = palette['wall-edge'];
    ctx.lineWidth = 1;
    ctx.strokeRect(left, top, (x_max_m - x_min_m) * now.pxPerM, (y_max_m - y_min_m) * now.pxPerM);
    if (marked === undefined) return;
    const { tool, bead } = placesAt(sample, marked);
    const place = ([x, y]: Vec2): string => `(${fixed(x, 2)}, ${fixed(y, 2)}) m`;
    setWords(`Tool ${place(tool)}, bead ${place(bead)}`);
  };

  onMount(() => {
    const observer = new ResizeObserver(() => {
      setSize({ width: canvas.clientWidth, height: canvas.clientHeight });
    });
    observer.observe(canvas);
    onCleanup(() => {
      observer.disconnect();
    });
    props.onDraw(draw);
    createEffect(on([view, walls, props.palette, figure.pointed_s], draw));
  });

  const point = (event: PointerEvent): void => {
    const now = view();
    const sample = figure.sample();
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

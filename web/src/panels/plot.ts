// One plot against simulated time: a uPlot with the page's colours, disturbances and threshold.

import uPlot from 'uplot';
import { fixed } from '../format';
import type { Column } from '../history';
import type { Palette } from '../palette';

export interface Line {
  readonly column: Column;
  readonly label: string;
  readonly color: keyof Palette;
}

export interface PlotSpec {
  readonly title: string;
  readonly unit: string;
  /** Shown value = metres × scale. */
  readonly scale: number;
  readonly digits: number;
  readonly lines: readonly Line[];
  /** The axis ends on multiples of this and spans at least two of them, in shown units. */
  readonly grain: number;
  /** Whether the axis starts at zero and shows the threshold of the switching law. */
  readonly threshold: boolean;
}

export interface PlotContext {
  readonly palette: () => Palette;
  /** Times of disturbances, in seconds. */
  readonly disturbances: () => readonly number[];
  /** Threshold T in metres. */
  readonly threshold_m: () => number | undefined;
}

/** Ends of an axis: multiples of `grain` around the data, at least two grains apart. */
export function axisRange(min: number, max: number, grain: number): [number, number] {
  let low = Math.floor(min / grain + 1e-6) * grain;
  let high = Math.ceil(max / grain - 1e-6) * grain;
  while (high - low < 2 * grain) {
    low -= grain / 2;
    high += grain / 2;
  }
  return [low, high];
}

const AXIS_FONT = '10px system-ui, sans-serif';

function drawMarks(u: uPlot, spec: PlotSpec, context: PlotContext): void {
  const { ctx, bbox } = u;
  const palette = context.palette();
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.lineWidth = window.devicePixelRatio;
  ctx.strokeStyle = palette.hand;
  ctx.beginPath();
  for (const time of context.disturbances()) {
    const x = Math.round(u.valToPos(time, 'x', true)) + 0.5;
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
  }
  ctx.stroke();
  const threshold_m = context.threshold_m();
  if (spec.threshold && threshold_m !== undefined) {
    const y = Math.round(u.valToPos(threshold_m * spec.scale, 'y', true)) + 0.5;
    ctx.strokeStyle = palette.danger;
    ctx.setLineDash([6 * window.devicePixelRatio, 4 * window.devicePixelRatio]);
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
    ctx.fillStyle = palette.danger;
    ctx.font = `${11 * window.devicePixelRatio}px system-ui, sans-serif`;
    ctx.textAlign = 'left';
    ctx.textBaseline = 'bottom';
    ctx.fillText('T', bbox.left + 5, y - 1);
  }
  ctx.restore();
}

export function createPlot(
  root: HTMLElement,
  spec: PlotSpec,
  context: PlotContext,
  onCursor: (index: number | undefined) => void,
): uPlot {
  const axis = {
    stroke: () => context.palette().muted,
    font: AXIS_FONT,
    grid: { stroke: () => context.palette().grid, width: 1 },
    ticks: { show: false },
    gap: 3,
  };
  return new uPlot(
    {
      width: Math.max(50, root.clientWidth),
      height: Math.max(40, root.clientHeight),
      legend: { show: false },
      cursor: { sync: { key: 'ferry' }, drag: { x: false, y: false }, points: { size: 5 } },
      scales: {
        x: { time: false, auto: false },
        y: {
          range: (_u, min, max) => {
            const top = spec.threshold ? (context.threshold_m() ?? 0) * spec.scale * 1.25 : max;
            return axisRange(spec.threshold ? 0 : min, Math.max(max, top), spec.grain);
          },
        },
      },
      axes: [
        { ...axis, size: 18, values: (_u, ticks) => ticks.map((tick) => `${tick} s`), space: 60 },
        {
          ...axis,
          size: 42,
          space: 18,
          values: (_u, ticks) => ticks.map((tick) => fixed(tick, spec.digits)),
        },
      ],
      series: [
        {},
        ...spec.lines.map((line) => ({
          label: line.label,
          stroke: () => context.palette()[line.color],
          width: 1.5,
          points: { show: false },
        })),
      ],
      hooks: {
        draw: [
          (u) => {
            drawMarks(u, spec, context);
          },
        ],
        setCursor: [
          (u) => {
            onCursor(u.cursor.idx ?? undefined);
          },
        ],
      },
      padding: [6, 14, 0, 0],
    },
    [[], ...spec.lines.map(() => [])],
    root,
  );
}

// One part of the figure over simulated time: a uPlot in the page's colours with marks.

import uPlot from 'uplot';
import { fixed } from '../../ui/format';
import type { Palette } from '../../ui/palette';
import { inside } from '../../ui/plotArea';
import { type Part, partRange } from './parts';
import type { Sample } from './sample';

export interface PlotContext {
  readonly palette: () => Palette;
  readonly sample: () => Sample | undefined;
  /** Threshold T in metres. */
  readonly threshold_m: () => number | undefined;
}

const AXIS_FONT = '10px system-ui, sans-serif';
const SHADE_ALPHA = 0.16;
/** The present time is marked only if it is at least this far before the newest sample. */
const BEHIND_S = 0.02;

/** Number of decimals needed to distinguish multiples of `step`. */
export function decimals(step: number): number {
  return String(step).split('.')[1]?.length ?? 0;
}

/** Below the lines: times of sub-controller 1. */
function drawApproaches(u: uPlot, context: PlotContext): void {
  inside(u, (ctx) => {
    ctx.fillStyle = context.palette()['mode-1'];
    ctx.globalAlpha = SHADE_ALPHA;
    for (const [from_s, to_s] of context.sample()?.approaches ?? []) {
      const from = u.valToPos(from_s, 'x', true);
      ctx.fillRect(from, u.bbox.top, u.valToPos(to_s, 'x', true) - from, u.bbox.height);
    }
  });
}

/** Over the lines: disturbances, the threshold, and the present time after a rewind. */
function drawMarks(u: uPlot, part: Part, context: PlotContext): void {
  const sample = context.sample();
  const palette = context.palette();
  const { bbox } = u;
  inside(u, (ctx, ratio) => {
    const upright = (time_s: number): void => {
      const x = Math.round(u.valToPos(time_s, 'x', true)) + 0.5;
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
    };
    ctx.lineWidth = ratio;
    ctx.strokeStyle = palette.hand;
    ctx.beginPath();
    for (const { time_s } of sample?.struck ?? []) upright(time_s);
    ctx.stroke();
    const newest_s = sample?.columns.sim_time_s.at(-1) ?? 0;
    if (sample && sample.at_s < newest_s - BEHIND_S) {
      ctx.strokeStyle = palette.focus;
      ctx.lineWidth = 2 * ratio;
      ctx.beginPath();
      upright(sample.at_s);
      ctx.stroke();
      ctx.lineWidth = ratio;
    }
    const threshold_m = context.threshold_m();
    if (!part.threshold || threshold_m === undefined) return;
    const y = Math.round(u.valToPos(threshold_m * part.scale, 'y', true)) + 0.5;
    ctx.strokeStyle = palette.danger;
    ctx.setLineDash([6 * ratio, 4 * ratio]);
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
    ctx.fillStyle = palette.danger;
    ctx.font = `${11 * ratio}px system-ui, sans-serif`;
    ctx.textAlign = 'left';
    ctx.textBaseline = 'bottom';
    ctx.fillText('T', bbox.left + 5 * ratio, y - ratio);
  });
}

/** `onPoint` is called with the pointer's time in seconds, and with undefined when the pointer leaves. */
export function createTimePlot(
  root: HTMLElement,
  part: Part,
  context: PlotContext,
  onPoint: (time_s: number | undefined) => void,
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
      cursor: { y: false, drag: { x: false, y: false }, points: { size: 5 } },
      scales: {
        x: { time: false, auto: false },
        y: { range: (_u, min, max) => partRange(part, min, max, context.threshold_m()) },
      },
      axes: [
        { ...axis, size: 16, values: (_u, ticks) => ticks.map((tick) => `${tick} s`), space: 50 },
        {
          ...axis,
          size: 38,
          space: 16,
          values: (_u, ticks, _axis, _space, step) =>
            ticks.map((tick) => fixed(tick, Math.max(part.digits, decimals(step)))),
        },
      ],
      series: [
        {},
        ...part.lines.map((line) => ({
          label: line.label,
          stroke: () => context.palette()[line.color],
          width: 1.5,
          points: { show: false },
        })),
      ],
      hooks: {
        drawAxes: [
          (u) => {
            drawApproaches(u, context);
          },
        ],
        draw: [
          (u) => {
            drawMarks(u, part, context);
          },
        ],
        setCursor: [
          (u) => {
            const { left } = u.cursor;
            onPoint(left === undefined || left < 0 ? undefined : u.posToVal(left, 'x'));
          },
        ],
      },
      padding: [5, 14, 0, 0],
    },
    [[], ...part.lines.map(() => [])],
    root,
  );
}

/** Draws what `sample` holds of the part. */
export function showSample(u: uPlot, part: Part, sample: Sample): void {
  const scaled = part.lines.map(({ column }) =>
    sample.columns[column].map((value) => value * part.scale),
  );
  const data = [sample.columns.sim_time_s, ...scaled] as unknown as uPlot.AlignedData;
  u.batch(() => {
    u.setData(data, false);
    u.setScale('x', { min: sample.from_s, max: sample.to_s });
  });
}

/** Puts the cursor at a time, or takes it away. */
export function showCursor(u: uPlot, time_s: number | undefined): void {
  const left = time_s === undefined ? -10 : u.valToPos(time_s, 'x');
  u.setCursor({ left, top: left < 0 ? -10 : 5 }, false);
}

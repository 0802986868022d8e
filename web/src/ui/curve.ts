// A plot of a computed curve: a uPlot in the page's colours with marks.

import uPlot from 'uplot';
import { dashOf, isController } from './controllers';
import { palette, type Palette } from './palette';

export interface CurveLine {
  readonly label: string;
  readonly color: keyof Palette;
  readonly isDashed?: boolean;
  /** Only the edge of a band: the line itself is not drawn. */
  readonly isEdge?: boolean;
  /** Whether the line goes on across points without a value. */
  readonly joinsGaps?: boolean;
  readonly hasPoints?: boolean;
}

/** A controller has its dash wherever it is shown. */
export function dashesOf(
  { color, isDashed = false }: Pick<CurveLine, 'color' | 'isDashed'>,
  width_px: number,
): number[] {
  if (isDashed) return [5, 3];
  return isController(color) ? dashOf(color, width_px) : [];
}

/** An interval of x, filled. */
export interface Shade {
  readonly from: number;
  readonly to: number;
  readonly color: keyof Palette;
}

/** A straight line across the plot. */
export interface Rule {
  readonly axis: 'x' | 'y';
  readonly at: number;
  readonly label: string;
  readonly color: keyof Palette;
  readonly dashed: boolean;
  readonly isStrong?: boolean;
}

export interface CurveContext {
  /** The numbers of the axes are beside the plot, which has only their lines. */
  readonly isBare?: boolean;
  readonly lines: readonly CurveLine[];
  /** Pairs of lines, upper one first, with the area between them filled in the colour of the upper one. */
  readonly bands?: readonly (readonly [number, number])[];
  /** Pairs of lines whose points are joined by an error bar in the colour of the upper one. */
  readonly bars?: readonly (readonly [number, number])[];
  readonly xRange: () => [number, number];
  readonly yRange: (max: number, min: number) => [number, number];
  /** Where the axis has its numbers, of which `most` have room; without, at round ones. */
  readonly xSplits?: (most: number) => number[];
  /** Where a bare plot of this height has lines across. */
  readonly ySplits?: (height_px: number) => number[];
  readonly xText?: (value: number) => string;
  /** `step` is the distance to the next number. */
  readonly yText?: (value: number, step: number) => string;
  readonly shades?: () => readonly Shade[];
  readonly rules?: () => readonly Rule[];
  /** Called with the point under the pointer, and with nothing when the pointer leaves. */
  readonly onCursor?: (index: number | undefined) => void;
}

const FACE = "'Inter Variable', system-ui, sans-serif";
const FONT = `500 12px ${FACE}`;
const GAP_PX = 3;
/** Least distance of two numbers on the x axis. */
const SPACE_PX = 52;
/** Of the y axis, unless its numbers need more. */
const LEAST_WIDTH_PX = 34;
const CAP_PX = 3;
const SHADE_ALPHA = 0.14;
/** Two hexadecimal digits of opacity. */
const FILL_ALPHA = '24';

/** Adds an opacity to `#rrggbb`. Other notations stay unchanged. */
function translucent(color: string): string {
  return /^#[0-9a-f]{6}$/i.test(color) ? color + FILL_ALPHA : color;
}

/** Draws over the plot, clipped to its axes. `ratio` is canvas pixels per CSS pixel. */
function inside(u: uPlot, draw: (ctx: CanvasRenderingContext2D, ratio: number) => void): void {
  const { ctx, bbox } = u;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  draw(ctx, window.devicePixelRatio);
  ctx.restore();
}

function drawShades(u: uPlot, context: CurveContext): void {
  inside(u, (ctx) => {
    ctx.globalAlpha = SHADE_ALPHA;
    for (const shade of context.shades?.() ?? []) {
      const from = u.valToPos(shade.from, 'x', true);
      const to = u.valToPos(shade.to, 'x', true);
      ctx.fillStyle = palette()[shade.color];
      ctx.fillRect(from, u.bbox.top, to - from, u.bbox.height);
    }
  });
}

function drawRule(u: uPlot, rule: Rule, ctx: CanvasRenderingContext2D, ratio: number): void {
  const { bbox } = u;
  const at = Math.round(u.valToPos(rule.at, rule.axis, true)) + 0.5;
  ctx.setLineDash(rule.dashed ? [6 * ratio, 4 * ratio] : []);
  ctx.beginPath();
  if (rule.axis === 'x') {
    ctx.moveTo(at, bbox.top);
    ctx.lineTo(at, bbox.top + bbox.height);
  } else {
    ctx.moveTo(bbox.left, at);
    ctx.lineTo(bbox.left + bbox.width, at);
  }
  ctx.stroke();
  ctx.textBaseline = rule.axis === 'x' ? 'top' : 'bottom';
  ctx.textAlign = rule.axis === 'x' ? 'left' : 'right';
  if (rule.axis === 'x') ctx.fillText(rule.label, at + 4 * ratio, bbox.top + 2 * ratio);
  else ctx.fillText(rule.label, bbox.left + bbox.width - 4 * ratio, at - ratio);
}

function drawRules(u: uPlot, context: CurveContext): void {
  inside(u, (ctx, ratio) => {
    ctx.font = `500 ${12 * ratio}px ${FACE}`;
    for (const rule of context.rules?.() ?? []) {
      ctx.lineWidth = (rule.isStrong ? 2 : 1) * ratio;
      ctx.strokeStyle = palette()[rule.color];
      ctx.fillStyle = palette()[rule.color];
      drawRule(u, rule, ctx, ratio);
    }
  });
}

function drawBars(u: uPlot, context: CurveContext): void {
  inside(u, (ctx, ratio) => {
    ctx.lineWidth = 1.5 * ratio;
    for (const [upper, lower] of context.bars ?? []) {
      const [highs, lows] = [u.data[upper + 1], u.data[lower + 1]];
      ctx.strokeStyle = palette()[context.lines[upper]?.color ?? 'ink'];
      ctx.beginPath();
      u.data[0].forEach((x, index) => {
        const ends = [highs?.[index], lows?.[index]];
        const px = u.valToPos(x, 'x', true);
        const [top, bottom] = ends.map((y) =>
          typeof y === 'number' ? u.valToPos(y, 'y', true) : NaN,
        );
        if (top === undefined || bottom === undefined || Number.isNaN(top + bottom)) return;
        ctx.moveTo(px, top);
        ctx.lineTo(px, bottom);
        for (const end of [top, bottom]) {
          ctx.moveTo(px - CAP_PX * ratio, end);
          ctx.lineTo(px + CAP_PX * ratio, end);
        }
      });
      ctx.stroke();
    }
  });
}

/** As wide as its longest number. */
function widthPx({ ctx }: uPlot, texts: readonly string[]): number {
  ctx.save();
  ctx.font = FONT;
  const widths = texts.map((text) => ctx.measureText(text).width);
  ctx.restore();
  return Math.max(LEAST_WIDTH_PX, Math.ceil(Math.max(...widths) + 2 * GAP_PX));
}

export function createCurve(root: HTMLElement, context: CurveContext): uPlot {
  const axis = {
    stroke: () => palette()['ink-3'],
    font: FONT,
    grid: { stroke: () => palette().line, width: 1 },
    ticks: { show: false },
    gap: GAP_PX,
  };
  const { xSplits, ySplits, isBare = false } = context;
  return new uPlot(
    {
      width: Math.max(50, root.clientWidth),
      height: Math.max(40, root.clientHeight),
      legend: { show: false },
      cursor: { y: false, drag: { x: false, y: false }, points: { size: 5 } },
      scales: {
        x: { time: false, range: () => context.xRange() },
        y: { range: (_u, min, max) => context.yRange(max, min) },
      },
      axes: [
        {
          ...axis,
          size: isBare ? 0 : 20,
          space: SPACE_PX,
          values: (_u, ticks) => ticks.map((tick) => context.xText?.(tick) ?? ''),
          ...(xSplits && {
            splits: (u) => xSplits(u.bbox.width / window.devicePixelRatio / SPACE_PX),
          }),
        },
        {
          ...axis,
          size: (u, texts: readonly string[] | null) => (isBare ? 0 : widthPx(u, texts ?? [])),
          space: 18,
          values: (_u, ticks, _axis, _space, step) =>
            ticks.map((tick) => context.yText?.(tick, step) ?? ''),
          ...(isBare && {
            splits: (u) => ySplits?.(u.height) ?? [],
          }),
        },
      ],
      series: [
        {},
        ...context.lines.map((line) => ({
          label: line.label,
          stroke: () => palette()[line.color],
          width: line.isEdge ? 0 : 1.5,
          pxAlign: 0,
          spanGaps: line.joinsGaps ?? false,
          dash: dashesOf(line, 1.5),
          // Dots are dashes of no length.
          cap: 'round' as const,
          points: { show: line.hasPoints ?? false, size: 5 },
        })),
      ],
      bands: (context.bands ?? []).map(([upper, lower]) => ({
        series: [upper + 1, lower + 1],
        fill: () => translucent(palette()[context.lines[upper]?.color ?? 'ink']),
      })),
      hooks: {
        drawAxes: [(u) => drawShades(u, context)],
        draw: [
          (u) => {
            drawBars(u, context);
            drawRules(u, context);
          },
        ],
        setCursor: [
          (u) => {
            const { left = -1, idx } = u.cursor;
            // Not if it was put there.
            if (left < 0 || u.over.matches(':hover')) context.onCursor?.(idx ?? undefined);
          },
        ],
      },
      padding: isBare ? [2, 0, 2, 0] : [6, 20, 0, 0],
    },
    [[], ...context.lines.map(() => [])],
    root,
  );
}

/** Puts the cursor at a place on the x axis, or takes it away. */
export function showCursor(u: uPlot, at: number | undefined): void {
  const left = at === undefined ? -10 : u.valToPos(at, 'x');
  u.setCursor({ left, top: left < 0 ? -10 : 5 }, false);
}

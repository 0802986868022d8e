// The figure as an SVG file: the same six parts, independent of the screen size. Pure.

import { fixed } from '../../ui/format';
import { GOAL_RADIUS_M, type Polygon, type Rect } from '../../net/protocol.gen';
import { fitView, pxFromWorld } from '../../plan/transform';
import {
  type Line,
  linesOf,
  LOCUS_LETTER,
  type Part,
  partRange,
  PARTS,
  presentRules,
  rulesOf,
  thresholdAbove,
} from './parts';
import type { Sample } from './sample';
import type { Vec2 } from '../../lab/geometry';
import type { Palette } from '../../ui/palette';
import { roundTicks } from './ticks';

export interface FigureFacts {
  /** One line about the trial. */
  readonly title: string;
  readonly palette: Palette;
  readonly sample: Sample;
  readonly threshold_m: number;
  readonly workspace: Rect;
  readonly walls: readonly Polygon[];
  readonly goal_m: Vec2 | undefined;
}

export const FIGURE_PX = { width: 960, height: 500 } as const;
const COLUMNS = 3;
const HEAD_PX = 30;
const CELL = { width: FIGURE_PX.width / COLUMNS, height: (FIGURE_PX.height - HEAD_PX) / 2 };
const INSET = { left: 46, right: 12, top: 24, bottom: 22 };
const BOX = {
  width: CELL.width - INSET.left - INSET.right,
  height: CELL.height - INSET.top - INSET.bottom,
};
const TICKS = 4;
const TRAILS = [
  { label: 'magnet', color: 'magnet-line' },
  { label: 'bead', color: 'bead-line' },
] as const;
const CROSS_PX = 4;

const escaped = (text: string): string =>
  text.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);

const n = (value: number): string => value.toFixed(1);

function text(at: Vec2, content: string, color: string, more = ''): string {
  return `<text x="${n(at[0])}" y="${n(at[1])}" fill="${color}" ${more}>${escaped(content)}</text>`;
}

function polyline(points: readonly Vec2[], color: string): string {
  const path = points.map(([x, y]) => `${n(x)},${n(y)}`).join(' ');
  return `<polyline points="${path}" fill="none" stroke="${color}" stroke-width="1.5" stroke-linejoin="round"/>`;
}

function line(a: Vec2, b: Vec2, color: string, more = ''): string {
  return `<line x1="${n(a[0])}" y1="${n(a[1])}" x2="${n(b[0])}" y2="${n(b[1])}" stroke="${color}" ${more}/>`;
}

function caption(
  letter: string,
  title: string,
  keys: readonly Pick<Line, 'label' | 'color'>[],
  palette: Palette,
): string {
  const marks = keys.map(({ label, color }, index) => {
    const x = CELL.width - INSET.right - 46 * (keys.length - index);
    const mark = line([x, 12], [x + 12, 12], palette[color], 'stroke-width="3"');
    return mark + text([x + 16, 16], label, palette[color]);
  });
  return (
    text([INSET.left, 16], `(${letter}) ${title}`, palette.ink, 'font-weight="600"') +
    marks.join('')
  );
}

function timePart(part: Part, facts: FigureFacts): string {
  const { sample, palette, threshold_m } = facts;
  const times = sample.columns.sim_time_s;
  const values = linesOf(part, sample);
  const range = partRange(part, values, threshold_m);
  const [low, high] = range;
  const x = (time_s: number): number =>
    INSET.left + (BOX.width * (time_s - sample.from_s)) / (sample.to_s - sample.from_s);
  const y = (value: number): number => INSET.top + BOX.height * (1 - (value - low) / (high - low));
  const bottom = INSET.top + BOX.height;
  const right = INSET.left + BOX.width;
  const out: string[] = [];
  for (const [from_s, to_s] of sample.approaches) {
    const width = Math.max(0.5, x(to_s) - x(from_s));
    out.push(
      `<rect x="${n(x(from_s))}" y="${INSET.top}" width="${n(width)}" height="${n(BOX.height)}" fill="${palette['ink-3']}" fill-opacity="0.16"/>`,
    );
  }
  const tick = (from: Vec2, to: Vec2, at: Vec2, number: string, anchor: string): void => {
    out.push(line(from, to, palette['floor-grid']));
    out.push(text(at, number, palette['ink-3'], `text-anchor="${anchor}"`));
  };
  for (const value of roundTicks(low, high, TICKS)) {
    const [at, number] = [y(value), fixed(value, part.digits)];
    tick([INSET.left, at], [right, at], [INSET.left - 5, at + 4], number, 'end');
  }
  for (const time_s of roundTicks(sample.from_s, sample.to_s, TICKS)) {
    const [at, number] = [x(time_s), `${Number(time_s.toFixed(3))} s`];
    tick([at, INSET.top], [at, bottom], [at, bottom + 14], number, 'middle');
  }
  for (const rule of [...rulesOf(part, sample, threshold_m, range), ...presentRules(sample)]) {
    const color = palette[rule.color];
    const dashes = rule.dashed ? 'stroke-dasharray="6 4"' : '';
    if (rule.axis === 'x') {
      out.push(line([x(rule.at), INSET.top], [x(rule.at), bottom], color, dashes));
    } else {
      const at = y(rule.at);
      out.push(line([INSET.left, at], [right, at], color, dashes));
      out.push(text([INSET.left + 4, at - 3], rule.label, color));
    }
  }
  const above = thresholdAbove(part, threshold_m, range);
  if (above) {
    out.push(text([right - 4, INSET.top + 12], above, palette.danger, 'text-anchor="end"'));
  }
  part.lines.forEach(({ color }, index) => {
    const points = Array.from(values[index] ?? [], (value, k): Vec2 => [
      x(times[k] ?? 0),
      y(value),
    ]);
    out.push(polyline(points, palette[color]));
  });
  return caption(part.letter, `${part.title} in ${part.unit}`, part.lines, palette) + out.join('');
}

function locusPart(facts: FigureFacts): string {
  const { sample, palette, workspace } = facts;
  const { columns } = sample;
  const view = fitView(workspace, CELL.width, CELL.height, { ...INSET, left: 12, bottom: 8 });
  const [left, top] = pxFromWorld(view, [workspace.x_min_m, workspace.y_max_m]);
  const [right, bottom] = pxFromWorld(view, [workspace.x_max_m, workspace.y_min_m]);
  const ring = (vertices: readonly Vec2[]): string =>
    `M${vertices.map((vertex) => pxFromWorld(view, vertex).map(n).join(' ')).join('L')}Z`;
  const walls = facts.walls
    .flatMap(({ exterior, holes }) => [exterior, ...holes].map(ring))
    .join('');
  const way = (xs: Float64Array, ys: Float64Array): Vec2[] =>
    [...xs].map((x_m, index) => pxFromWorld(view, [x_m, ys[index] ?? 0]));
  const out = [
    `<rect x="${n(left)}" y="${n(top)}" width="${n(right - left)}" height="${n(bottom - top)}" fill="${palette.floor}" stroke="${palette['wall-rim']}"/>`,
    `<path d="${walls}" fill="${palette.wall}" fill-opacity="0.45" fill-rule="evenodd"/>`,
    polyline(way(columns.tool_x_m, columns.tool_y_m), palette.magnet),
    polyline(way(columns.bead_x_m, columns.bead_y_m), palette.bead),
  ];
  if (facts.goal_m) {
    const [x, y] = pxFromWorld(view, facts.goal_m);
    out.push(
      `<circle cx="${n(x)}" cy="${n(y)}" r="${n(GOAL_RADIUS_M * view.pxPerM)}" fill="none" stroke="${palette.goal}" stroke-width="1.5"/>`,
    );
  }
  for (const { at_m } of sample.struck) {
    const [x, y] = pxFromWorld(view, at_m);
    for (const side of [1, -1]) {
      out.push(
        line(
          [x - CROSS_PX, y - side * CROSS_PX],
          [x + CROSS_PX, y + side * CROSS_PX],
          palette.you,
          'stroke-width="2"',
        ),
      );
    }
  }
  return caption(LOCUS_LETTER, 'Locus', TRAILS, palette) + out.join('');
}

/** In the paper's order, three parts per row. */
export function figureSvg(facts: FigureFacts): string {
  const { width, height } = FIGURE_PX;
  const cells = [...PARTS.map((part) => timePart(part, facts)), locusPart(facts)];
  const placed = cells.map((cell, index) => {
    const x = (index % COLUMNS) * CELL.width;
    const y = HEAD_PX + Math.floor(index / COLUMNS) * CELL.height;
    return `<g transform="translate(${n(x)} ${n(y)})">${cell}</g>`;
  });
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif" font-size="11">` +
    `<title>${escaped(facts.title)}</title>` +
    `<rect width="${width}" height="${height}" fill="${facts.palette.surface}"/>` +
    text([12, 20], facts.title, facts.palette['ink-3']) +
    placed.join('') +
    '</svg>'
  );
}

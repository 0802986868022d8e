// The cells of a recovery map as shapes of a drawing. Pure.

import { nextToward, type Vec2 } from '../../lab/geometry';
import type { Rect, RecoveryCell, RecoveryReport } from '../../net/protocol.gen';
import { fixed } from '../../ui/format';
import { mm, rowsOf } from './cells';

export interface Shape {
  readonly cell: number;
  /** Path of the outline. */
  readonly path: string;
  /** Its middle; y points down. */
  readonly middle: readonly [x: number, y: number];
}

/** A number of an axis, centred at its place. */
export interface Label {
  readonly text: string;
  readonly at: readonly [x: number, y: number];
}

export interface Drawing {
  readonly box: readonly [x: number, y: number, width: number, height: number];
  readonly shapes: readonly Shape[];
  readonly labels: readonly Label[];
}

const ROUND = 200;
const BLIND_WIDE = 320;
const BLIND_HIGH = 160;
/** Room for the numbers of the axes. */
const LEFT = 26;
const BELOW = 16;
/** Least distance of two times. */
const APART = 46;
/** A little space between cells. */
const GAP = 0.06;

const at = (x: number, y: number): string => `${x.toFixed(1)} ${y.toFixed(1)}`;

function box(x: number, y: number, width: number, height: number): string {
  return `M${at(x, y)}h${width.toFixed(1)}v${height.toFixed(1)}h${(-width).toFixed(1)}z`;
}

function places(rows: readonly RecoveryCell[], workspace: Rect): Drawing {
  const shapes = rows.map((row) => {
    const side = mm(row.size_m ?? 0);
    const middle = [mm(row.x_m ?? 0), -mm(row.y_m ?? 0)] as const;
    const inner = side * (1 - GAP);
    return {
      cell: row.cell,
      middle,
      path: box(middle[0] - inner / 2, middle[1] - inner / 2, inner, inner),
    };
  });
  const { x_min_m, x_max_m, y_min_m, y_max_m } = workspace;
  return {
    box: [mm(x_min_m), -mm(y_max_m), mm(x_max_m - x_min_m), mm(y_max_m - y_min_m)],
    shapes,
    labels: [],
  };
}

/** The different values of a column, in order. */
function steps(
  rows: readonly RecoveryCell[],
  value: 'strength' | 'at_s' | 'direction_rad',
): number[] {
  return [...new Set(rows.map((row) => row[value] ?? 0))].sort((a, b) => a - b);
}

/** Rings of sectors, the strongest outside. */
function sectors(rows: readonly RecoveryCell[], kind: 'push' | 'drag'): Drawing {
  const [strengths, directions] = [steps(rows, 'strength'), steps(rows, 'direction_rad')];
  const ring = ROUND / (strengths.length + 1);
  const half = Math.PI / Math.max(1, directions.length);
  const shapes = rows.map((row) => {
    const inner = ring * (strengths.indexOf(row.strength ?? 0) + 1);
    const outer = inner + ring * (1 - GAP);
    const direction = row.direction_rad ?? 0;
    const corner = (radius: number, angle: number): string =>
      at(radius * Math.cos(angle), -radius * Math.sin(angle));
    const [from, to] = [direction - half * (1 - GAP), direction + half * (1 - GAP)];
    const path = `M${corner(inner, from)}L${corner(outer, from)}A${at(outer, outer)} 0 0 0 ${corner(outer, to)}L${corner(inner, to)}A${at(inner, inner)} 0 0 1 ${corner(inner, from)}z`;
    const radius = (inner + outer) / 2;
    const middle = [radius * Math.cos(direction), -radius * Math.sin(direction)] as const;
    return { cell: row.cell, path, middle };
  });
  const [scale, unit] = kind === 'push' ? [1000, 'mN'] : [100, 'cm'];
  const labels = strengths.map((strength, index): Label => {
    const isLast = index === strengths.length - 1;
    const text = `${fixed(strength * scale, 1)}${isLast ? ` ${unit}` : ''}`;
    return { text, at: [0, ring * (index + 1.5)] };
  });
  return { box: [-ROUND, -ROUND, 2 * ROUND, 2 * ROUND], shapes, labels };
}

/** Times to the right, durations upward. */
function losses(rows: readonly RecoveryCell[]): Drawing {
  const [durations, times] = [steps(rows, 'strength'), steps(rows, 'at_s')];
  const [wide, high] = [BLIND_WIDE / times.length, BLIND_HIGH / durations.length];
  const shapes = rows.map((row) => {
    const x = times.indexOf(row.at_s ?? 0) * wide;
    const y = BLIND_HIGH - (durations.indexOf(row.strength ?? 0) + 1) * high;
    return {
      cell: row.cell,
      middle: [x + wide / 2, y + high / 2] as const,
      path: box(x, y, wide * (1 - GAP), high * (1 - GAP)),
    };
  });
  const every = Math.ceil(APART / wide);
  const labels = [
    ...durations.map((duration, index): Label => ({
      text: `${fixed(duration, 1)} s`,
      at: [-LEFT / 2, BLIND_HIGH - (index + 0.5) * high],
    })),
    ...times
      .map((time, index): Label => ({
        text: `at ${fixed(time, 1)} s`,
        at: [(index + 0.5) * wide, BLIND_HIGH + BELOW / 2],
      }))
      .filter((_, index) => index % every === 0),
  ];
  return { box: [-LEFT, 0, LEFT + BLIND_WIDE, BLIND_HIGH + BELOW], shapes, labels };
}

/** The cells of a controller. */
export function drawingOf(report: RecoveryReport, name: string, workspace: Rect): Drawing {
  const rows = rowsOf(report, name);
  if (report.kind === 'place') return places(rows, workspace);
  return report.kind === 'blind' ? losses(rows) : sectors(rows, report.kind);
}

/** The next shape from one toward a side; the same one at the edge. */
export function nextShape(
  shapes: readonly Shape[],
  from: number | undefined,
  direction: Vec2,
): number | undefined {
  const here = shapes.find(({ cell }) => cell === from)?.middle;
  if (!here) return shapes[0]?.cell;
  const middles = shapes.map(({ middle }) => middle);
  return shapes[nextToward(middles, here, direction) ?? -1]?.cell ?? from;
}

// Draws a value map of a training over the walls of its map, and the episodes that move on it.

import type { Vec2 } from '../../lab/geometry';
import type {
  EpisodeEnding,
  Rect,
  TrainingCells,
  TrainingEpisode,
  TrainingFrame,
} from '../../net/protocol.gen';
import { drawFloor, drawOutlines } from '../../plan/drawMap';
import { drawGoal } from '../../plan/drawMoving';
import { drawArrows, drawColours, type Values } from '../../plan/drawValues';
import { pxFromWorld, pxRect, type View } from '../../plan/transform';
import { placeAfter, startsThat } from './grid';
import type { Palette } from '../../ui/palette';

type Ctx = CanvasRenderingContext2D;

export interface Layers {
  readonly values: boolean;
  readonly arrows: boolean;
  readonly starts: boolean;
  readonly episodes: boolean;
}

interface Base {
  readonly view: View;
  readonly palette: Palette;
  readonly workspace: Rect;
  readonly walls: Path2D;
  readonly layers: Layers;
  readonly cells: TrainingCells | undefined;
  readonly frame: TrainingFrame | undefined;
  readonly values: Values | undefined;
  /** Index of the chosen cell. */
  readonly chosen: number | undefined;
}

/** A mark is in the corner of its cell, beside the arrow: its place and half its side as shares of a cell. */
const CORNER = 0.28;
const FAILED = 0.18;
const LEAST_MARK_PX = 0.9;
const MOST_MARK_PX = 4;

function cross(path: Path2D, [x, y]: Vec2, half: number): void {
  path.moveTo(x - half, y - half);
  path.lineTo(x + half, y + half);
  path.moveTo(x - half, y + half);
  path.lineTo(x + half, y - half);
}

function ring(path: Path2D, [x, y]: Vec2, radius: number): void {
  path.moveTo(x + radius, y);
  path.arc(x, y, radius, 0, 2 * Math.PI);
}

/** A cross for a wall, a ring for too many steps. */
function markOf(ending: EpisodeEnding): typeof cross {
  return ending === 'collided' ? cross : ring;
}

/** A line on a lighter one, so that it shows on every colour of a value. */
function strokeCased(
  ctx: Ctx,
  path: Path2D,
  palette: Palette,
  colour: string,
  width: number,
): void {
  ctx.lineCap = 'round';
  ctx.strokeStyle = palette.case;
  ctx.lineWidth = 2.2 * width;
  ctx.stroke(path);
  ctx.strokeStyle = colour;
  ctx.lineWidth = width;
  ctx.stroke(path);
}

function drawStarts(ctx: Ctx, base: Base, cells: TrainingCells, frame: TrainingFrame): void {
  const { view, palette } = base;
  const side = cells.spacing_m * view.pxPerM;
  const half = Math.min(MOST_MARK_PX, Math.max(LEAST_MARK_PX, FAILED * side));
  const path = new Path2D();
  for (const ending of ['collided', 'timed_out'] as const) {
    for (const index of startsThat(frame, ending)) {
      const center = cells.centers_m[index];
      if (!center) continue;
      const [x, y] = pxFromWorld(view, center);
      markOf(ending)(path, [x + CORNER * side, y + CORNER * side], half);
    }
  }
  strokeCased(ctx, path, palette, palette['m-danger'], Math.min(1.6, 0.9 * half));
}

function drawChosen(ctx: Ctx, { view, palette }: Base, cells: TrainingCells, center: Vec2): void {
  const side = Math.max(9, cells.spacing_m * view.pxPerM + 2);
  const [x, y] = pxFromWorld(view, center);
  for (const [colour, width] of [
    [palette.floor, 5],
    [palette.accent, 2.5],
  ] as const) {
    ctx.strokeStyle = colour;
    ctx.lineWidth = width;
    ctx.strokeRect(x - side / 2, y - side / 2, side, side);
  }
}

const CORNER_PX = 16;

export function drawBase(ctx: Ctx, base: Base): void {
  const { view, palette, layers, cells, frame, values } = base;
  ctx.save();
  // The corners of the box of the map are round.
  ctx.beginPath();
  ctx.roundRect(...pxRect(view, base.workspace), CORNER_PX);
  ctx.clip();
  drawFloor(ctx, base.workspace, view, palette);
  if (values && layers.values) drawColours(ctx, view, values);
  drawOutlines(ctx, base.workspace, base.walls, view, palette);
  if (cells && frame && layers.starts) drawStarts(ctx, base, cells, frame);
  if (values && layers.arrows) drawArrows(ctx, view, palette, values);
  ctx.restore();
  if (!cells) return;
  drawGoal(ctx, view, palette, cells.goal_m);
  const center = base.chosen === undefined ? undefined : cells.centers_m[base.chosen];
  if (center) drawChosen(ctx, base, cells, center);
}

const DOT_PX = 5;
const EPISODE_PX = 2.2;
const DOTS_PX = [0, 4.5];
/** White on black, on every colour of a value. */
const LINE = '#fff';
const CASING = '#000';

function drawEpisode(
  ctx: Ctx,
  { view, palette }: Pick<Base, 'view' | 'palette'>,
  cells: TrainingCells,
  episode: TrainingEpisode,
  steps: number,
  isGreedy: boolean,
): void {
  const at = placeAfter(cells, episode, steps);
  if (!at) return;
  const [x, y] = pxFromWorld(view, at);
  const path = new Path2D();
  for (const index of episode.cells.slice(0, Math.floor(steps) + 1)) {
    const center = cells.centers_m[index];
    if (center) path.lineTo(...pxFromWorld(view, center));
  }
  path.lineTo(x, y);
  ctx.lineCap = 'round';
  ctx.lineJoin = 'round';
  for (const [colour, width, dash] of [
    [CASING, 2 * EPISODE_PX, []],
    [LINE, EPISODE_PX, isGreedy ? [] : DOTS_PX],
  ] as const) {
    ctx.strokeStyle = colour;
    ctx.lineWidth = width;
    ctx.setLineDash([...dash]);
    ctx.stroke(path);
  }
  ctx.setLineDash([]);
  const end = new Path2D();
  const isOver = steps >= episode.cells.length - 1;
  if (isOver && episode.ending !== 'reached') {
    markOf(episode.ending)(end, [x, y], DOT_PX);
    strokeCased(ctx, end, palette, palette['m-danger'], 2.5);
    return;
  }
  ring(end, [x, y], DOT_PX);
  ctx.fillStyle = LINE;
  ctx.fill(end);
  ctx.strokeStyle = CASING;
  ctx.lineWidth = EPISODE_PX;
  ctx.stroke(end);
}

/** The episodes of a frame after a number of steps. */
export function drawEpisodes(
  ctx: Ctx,
  base: Pick<Base, 'view' | 'palette'>,
  cells: TrainingCells,
  frame: TrainingFrame,
  steps: number,
): void {
  for (const episode of frame.exploring) drawEpisode(ctx, base, cells, episode, steps, false);
  for (const episode of frame.greedy) drawEpisode(ctx, base, cells, episode, steps, true);
}

/** Steps of the longest episode. */
export function mostSteps({ greedy, exploring }: TrainingFrame): number {
  return Math.max(0, ...[...greedy, ...exploring].map(({ cells }) => cells.length - 1));
}

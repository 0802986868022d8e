// Draws a value map of a training over the walls of its map, and the episodes that move on it.

import { placeAfter, type Vec2 } from '../../lab/geometry';
import type {
  EpisodeEnding,
  TrainingCells,
  TrainingEpisode,
  TrainingFrame,
} from '../../net/protocol.gen';
import { drawFloor } from '../../plan/drawMap';
import type { Relief } from '../../plan/relief';
import { drawGoal } from '../../plan/drawMoving';
import { drawArrows, drawColours, type Values } from '../../plan/drawValues';
import { strokeCased } from '../../plan/marks';
import { pxFromWorld, type View } from '../../plan/transform';
import { startsThat } from './grid';
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
  readonly relief: Relief;
  readonly layers: Layers;
  readonly cells: TrainingCells | undefined;
  readonly frame: TrainingFrame | undefined;
  readonly values: Values | undefined;
  /** Index of the chosen cell. */
  readonly chosen: number | undefined;
}

/** A mark is in the corner of its cell, beside the arrow: its place and half its side as shares of a cell. */
const CORNER = 0.33;
const FAILED = 0.11;
const LEAST_MARK_PX = 0.9;
const MOST_MARK_PX = 3;

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
const markOf = (ending: EpisodeEnding): typeof cross => (ending === 'collided' ? cross : ring);

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
  strokeCased(ctx, palette, { colour: palette['m-danger'], width_px: Math.min(1.6, half) }, path);
}

function drawChosen(ctx: Ctx, { view, palette }: Base, cells: TrainingCells, center: Vec2): void {
  const side = Math.max(9, cells.spacing_m * view.pxPerM + 2);
  const [x, y] = pxFromWorld(view, center);
  ctx.beginPath();
  ctx.rect(x - side / 2, y - side / 2, side, side);
  strokeCased(ctx, palette, { colour: palette['m-cursor'], width_px: 2.5 });
}

export function drawBase(ctx: Ctx, base: Base): void {
  const { view, palette, relief, layers, cells, frame, values } = base;
  drawFloor(ctx, relief.tray.workspace, view, palette);
  if (values && layers.values) drawColours(ctx, view, values);
  relief.draw(ctx, view, true);
  if (cells && frame && layers.starts) drawStarts(ctx, base, cells, frame);
  if (values && layers.arrows) drawArrows(ctx, view, values);
  if (!cells) return;
  drawGoal(ctx, view, palette, cells.goal_m);
  const center = base.chosen === undefined ? undefined : cells.centers_m[base.chosen];
  if (center) drawChosen(ctx, base, cells, center);
}

const DOT_PX = 4.5;
/** White on black is seen on every colour of a value. */
const EPISODE = '#ffffff';
const EPISODE_EDGE = '#1b1108';
/** Of an episode with random steps. */
const RANDOM_DASH = [0.1, 5];

function drawEpisode(
  ctx: Ctx,
  base: Pick<Base, 'view' | 'palette'>,
  cells: TrainingCells,
  episode: TrainingEpisode,
  steps: number,
  isGreedy: boolean,
): void {
  const { view, palette } = base;
  const places = episode.cells
    .map((cell) => cells.centers_m[cell])
    .filter((one) => one !== undefined);
  const at = placeAfter(places, steps);
  if (!at) return;
  const line = { colour: EPISODE, edge: EPISODE_EDGE, width_px: 2.2 };
  ctx.beginPath();
  for (const place of places.slice(0, Math.floor(steps) + 1)) {
    ctx.lineTo(...pxFromWorld(view, place));
  }
  const [x, y] = pxFromWorld(view, at);
  ctx.lineTo(x, y);
  strokeCased(ctx, palette, isGreedy ? line : { ...line, dash: RANDOM_DASH });
  const isOver = steps >= episode.cells.length - 1;
  if (isOver && episode.ending !== 'reached') {
    const path = new Path2D();
    markOf(episode.ending)(path, [x, y], DOT_PX);
    strokeCased(ctx, palette, { colour: palette['m-danger'], width_px: 2.5 }, path);
    return;
  }
  ctx.beginPath();
  ctx.arc(x, y, DOT_PX, 0, 2 * Math.PI);
  ctx.fillStyle = isGreedy ? EPISODE : EPISODE_EDGE;
  strokeCased(ctx, palette, line);
  ctx.fill();
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

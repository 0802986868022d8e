// The recovery map of places on the plan: the controller that was looked at last, or the difference that is shown.

import { createEffect, createMemo, on } from 'solid-js';
import type { Vec2 } from '../../lab/geometry';
import type { Lab, Panels, Session, Trial } from '../../lab/slices';
import { GOAL_RADIUS_M, type RecoveryReport } from '../../net/protocol.gen';
import type { LayerContext, MapLayer } from '../../plan/layer';
import { drawText, strokeCased } from '../../plan/marks';
import { circle } from '../../plan/shapes';
import type { Ctx } from '../../plan/sheet';
import { pxFromWorld, type View } from '../../plan/transform';
import { cellAt, isForGoal, type Look, looksOf, rowsOf, titleOf } from './cells';
import * as store from './store';
import type { Palette } from '../../ui/palette';

const FAINTEST = 0.4;
/** Left free around each cell. */
const GAP_PX = 1.5;
const CORNER_PX = 3;
const TILE_PX = 8;

interface Square {
  readonly x_m: number;
  readonly y_m: number;
  readonly size_m: number;
  readonly look: Look;
  readonly isDropped: boolean;
  readonly isChosen: boolean;
}

/** Ground and lines of a cell's pattern; plain without lines. */
const LOOKS: Readonly<Record<Look['kind'], readonly [keyof Palette, (keyof Palette)?]>> = {
  delivered: ['delivered'],
  first: ['delivered'],
  late: ['late', 'late-stripes'],
  second: ['late', 'late-stripes'],
  lost: ['lost', 'lost-lattice'],
  equal: ['unseen'],
};

/** Stripes, or a lattice for lost: the layer is read without its colours, too. */
function patternOf(ctx: Ctx, palette: Palette, kind: Look['kind']): CanvasPattern | string {
  const [ground, lines] = LOOKS[kind];
  if (!lines) return palette[ground];
  const ratio = ctx.getTransform().a;
  const tile = document.createElement('canvas');
  tile.width = Math.round(TILE_PX * ratio);
  tile.height = tile.width;
  const onto = tile.getContext('2d');
  if (!onto) return palette[ground];
  const scale = tile.width / TILE_PX;
  onto.scale(scale, scale);
  onto.fillStyle = palette[ground];
  onto.fillRect(0, 0, TILE_PX, TILE_PX);
  onto.strokeStyle = palette[lines];
  onto.lineWidth = kind === 'lost' ? 1.4 : 2.6;
  for (const [x, y] of [
    [0, 0],
    [-TILE_PX, 0],
    [TILE_PX, 0],
  ] as const) {
    onto.moveTo(x - 1, y + TILE_PX + 1);
    onto.lineTo(x + TILE_PX + 1, y - 1);
    if (kind !== 'lost') continue;
    onto.moveTo(x - 1, y - 1);
    onto.lineTo(x + TILE_PX + 1, y + TILE_PX + 1);
  }
  onto.stroke();
  const pattern = ctx.createPattern(tile, 'repeat');
  pattern?.setTransform(new DOMMatrix().scale(1 / scale));
  return pattern ?? palette[ground];
}

function draw(ctx: Ctx, view: View, palette: Palette, squares: readonly Square[]): void {
  const fills = new Map<Look['kind'], CanvasPattern | string>();
  for (const { x_m, y_m, size_m, look, isDropped, isChosen } of squares) {
    const fill = fills.get(look.kind) ?? patternOf(ctx, palette, look.kind);
    fills.set(look.kind, fill);
    const [left, top] = pxFromWorld(view, [x_m - size_m / 2, y_m + size_m / 2]);
    const side = Math.max(1, size_m * view.pxPerM - GAP_PX);
    const isPlain = look.kind === 'delivered' || look.kind === 'first';
    ctx.globalAlpha = isPlain ? FAINTEST + (1 - FAINTEST) * look.strength : 1;
    ctx.fillStyle = fill;
    ctx.beginPath();
    ctx.roundRect(left + GAP_PX / 2, top + GAP_PX / 2, side, side, Math.min(CORNER_PX, side / 4));
    ctx.fill();
    ctx.globalAlpha = 1;
    if (isDropped) strokeCased(ctx, palette, { colour: palette['m-you'], width_px: 2.6 });
    if (isChosen) strokeCased(ctx, palette, { colour: palette['bead-edge'], width_px: 2.6 });
  }
}

/** The recovery map that is on the map. */
function reportOn(lab: Pick<Trial, 'scene'>): RecoveryReport | undefined {
  const report = store.report();
  return report?.kind === 'place' && report.map === lab.scene()?.map ? report : undefined;
}

/** Below a comparison it would hide the ghosts; for another goal it would be taken for a result of the present one. */
function unavailable(lab: Lab): string | undefined {
  if (lab.panel() === 'compare') return 'Hidden while Compare is open.';
  const report = reportOn(lab);
  if (!report || lab.panel() === 'recovery' || isForGoal(report, lab.goal())) return undefined;
  return 'Made for another goal. The tab Recovery shows it.';
}

/** Where the bead should go, if that is not the present goal. */
function drawItsGoal(ctx: Ctx, view: View, palette: Palette, goal_m: Vec2): void {
  const [x, y] = pxFromWorld(view, goal_m);
  const radius = GOAL_RADIUS_M * view.pxPerM;
  circle(ctx, [x, y], radius);
  strokeCased(ctx, palette, { colour: palette['m-goal'], width_px: 2.6, dash: [5, 5] });
  const { isTurned } = view;
  drawText(ctx, palette, 'earlier goal', [x, y], { align: 'center', isTurned });
}

export const RECOVERY_LAYER: MapLayer = {
  id: 'recovery',
  label: 'Recovery',
  swatch: ['delivered', 'late', 'lost'],
  group: 'Motion',
  shownAtFirst: true,
  unavailable,
  create: ({ lab }: LayerContext<Session & Trial & Panels>) => {
    // Where the hand lets the bead go, whichever tab is open.
    createEffect(
      on(
        () => lab.state()?.hand_m,
        (hand, before) => {
          const bead_m = lab.state()?.bead_m;
          if (before && !hand && bead_m) store.setDropped([bead_m[0], bead_m[1]]);
        },
      ),
    );
    createEffect(
      on(
        () => lab.scene()?.map,
        () => store.setDropped(undefined),
        { defer: true },
      ),
    );
    const squares = createMemo((): readonly Square[] => {
      const report = reportOn(lab);
      if (!report) return [];
      const pair = store.shownOf(report);
      const looks = looksOf(report, pair);
      const at = store.dropped();
      const dropped = at && cellAt(report, at);
      const chosen = lab.panel() === 'recovery' ? store.chosen()?.cell : undefined;
      return rowsOf(report, report.names[pair[0]] ?? '').flatMap((row) => {
        const look = looks.get(row.cell);
        const { x_m, y_m, size_m, cell } = row;
        if (!look || x_m === null || y_m === null || size_m === null) return [];
        return [{ x_m, y_m, size_m, look, isDropped: cell === dropped, isChosen: cell === chosen }];
      });
    });
    return {
      belowWalls: () => {
        const now = squares();
        if (now.length === 0) return undefined;
        return (ctx, { view, palette }) => {
          draw(ctx, view, palette, now);
        };
      },
      aboveWalls: () => {
        const report = reportOn(lab);
        const goal_m = report?.goal_m;
        if (!goal_m || isForGoal(report, lab.goal())) return undefined;
        return (ctx, { view, palette }) => {
          drawItsGoal(ctx, view, palette, goal_m);
        };
      },
      press: () => {
        const report = lab.panel() === 'recovery' ? reportOn(lab) : undefined;
        if (!report) return undefined;
        const indices = store.shownOf(report);
        const title = titleOf(report, indices);
        return {
          shown: indices.length > 1 ? title : `Where ${title} still delivers`,
          words: 'a cell to see its trials',
          at: (place) => {
            const cell = cellAt(report, place);
            if (cell === undefined) return undefined;
            return () => {
              store.setChosen({ cell, name: report.names[indices[0]] ?? '' });
            };
          },
        };
      },
    };
  },
};

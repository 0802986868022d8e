// The recovery map of places on the plan: the controller that was looked at last, or the difference that is shown.

import { createEffect, createMemo, on } from 'solid-js';
import type { Session, Trial } from '../../lab/slices';
import type { LayerContext, MapLayer } from '../../plan/layer';
import { strokeCased } from '../../plan/marks';
import type { Ctx } from '../../plan/sheet';
import { pxFromWorld, type View } from '../../plan/transform';
import { cellAt, type Look, looksOf, rowsOf } from './cells';
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
  for (const { x_m, y_m, size_m, look, isDropped } of squares) {
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
  }
}

export const RECOVERY_LAYER: MapLayer = {
  id: 'recovery',
  label: 'Recovery',
  swatch: ['delivered', 'late', 'lost'],
  group: 'Motion',
  shownAtFirst: true,
  create: ({ lab }: LayerContext<Session & Trial>) => {
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
    const squares = createMemo((): readonly Square[] => {
      const report = store.report();
      if (report?.kind !== 'place' || report.map !== lab.scene()?.map) return [];
      const front = Math.max(0, report.names.indexOf(store.chosen()?.name ?? ''));
      const pair = store.pair() ?? [front];
      const looks = looksOf(report, pair);
      const at = store.dropped();
      const dropped = at && cellAt(report, at);
      return rowsOf(report, report.names[pair[0]] ?? '').flatMap((row) => {
        const look = looks.get(row.cell);
        const { x_m, y_m, size_m, cell } = row;
        if (!look || x_m === null || y_m === null || size_m === null) return [];
        return [{ x_m, y_m, size_m, look, isDropped: cell === dropped }];
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
    };
  },
};

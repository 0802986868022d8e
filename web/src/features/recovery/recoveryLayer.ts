// The recovery map of places on the plan: the controller that was looked at last, or the difference that is shown.

import { createEffect, createMemo, on } from 'solid-js';
import type { Session, Trial } from '../../lab/slices';
import type { LayerContext, MapLayer } from '../../plan/layer';
import { pxFromWorld, type View } from '../../plan/transform';
import { cellAt, type Look, looksOf, rowsOf } from './cells';
import * as store from './store';
import type { Palette } from '../../ui/palette';

const FAINTEST = 0.15;
const DENSEST = 0.55;
const LINE_PX = 1;
const STRIPE_PX = 7;
/** Left free around each cell. */
const GAP_PX = 1;

interface Square {
  readonly x_m: number;
  readonly y_m: number;
  readonly size_m: number;
  readonly look: Look;
  readonly isDropped: boolean;
}

const COLOURS: Readonly<Record<Look['kind'], keyof Palette>> = {
  delivered: 'magnet',
  first: 'magnet',
  late: 'bead',
  second: 'bead',
  lost: 'danger',
  equal: 'ink-3',
};

/** Stripes for late and for the second, crosses for lost: the layer is read without its colours, too. */
function hatch(
  ctx: CanvasRenderingContext2D,
  [left, top, side]: readonly [number, number, number],
  isCrossed: boolean,
): void {
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top, side, side);
  ctx.clip();
  ctx.beginPath();
  for (let at = -side; at < side; at += STRIPE_PX) {
    ctx.moveTo(left + at, top + side);
    ctx.lineTo(left + at + side, top);
    if (isCrossed) {
      ctx.moveTo(left + at, top);
      ctx.lineTo(left + at + side, top + side);
    }
  }
  ctx.stroke();
  ctx.restore();
}

function draw(
  ctx: CanvasRenderingContext2D,
  view: View,
  palette: Palette,
  squares: readonly Square[],
): void {
  for (const { x_m, y_m, size_m, look, isDropped } of squares) {
    const [left, top] = pxFromWorld(view, [x_m - size_m / 2, y_m + size_m / 2]);
    const side = size_m * view.pxPerM - GAP_PX;
    const colour = palette[COLOURS[look.kind]];
    ctx.fillStyle = colour;
    ctx.strokeStyle = colour;
    ctx.lineWidth = LINE_PX;
    if (look.kind === 'delivered' || look.kind === 'first') {
      ctx.globalAlpha = FAINTEST + (DENSEST - FAINTEST) * look.strength;
      ctx.fillRect(left, top, side, side);
      ctx.globalAlpha = 1;
    } else if (look.kind !== 'equal') {
      ctx.globalAlpha = DENSEST;
      hatch(ctx, [left, top, side], look.kind === 'lost');
      ctx.globalAlpha = 1;
    }
    if (isDropped) {
      ctx.strokeStyle = palette.you;
      ctx.lineWidth = 3 * LINE_PX;
      ctx.strokeRect(left, top, side, side);
    }
  }
}

export const RECOVERY_LAYER: MapLayer = {
  id: 'recovery',
  label: 'Recovery',
  swatch: ['magnet', 'bead', 'danger'],
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
    createEffect(
      on(
        () => lab.scene()?.map,
        () => store.setDropped(undefined),
        { defer: true },
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

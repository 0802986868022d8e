// The layers of ERRT's plan.

import { createMemo } from 'solid-js';
import type { PlanLayer } from '../../net/protocol.gen';
import type { LayerContext, MapLayer } from '../../plan/layer';
import type { View } from '../../plan/transform';
import type { Palette } from '../../ui/palette';
import { createObstacles, createPlan, drawObstacles, drawPlan } from './drawPlan';
import type { Pictures } from '../../lab/slices';

/** Path2D objects are created again only for a new plan or view. */
function ofPlan<T>(
  layer: Pick<MapLayer, 'id' | 'label' | 'shownAtFirst'>,
  trace: (plan: PlanLayer, view: View) => T,
  draw: (ctx: CanvasRenderingContext2D, palette: Palette, traced: T) => void,
): MapLayer {
  return {
    ...layer,
    swatch: ['plan'],
    group: 'ERRT',
    create: ({ lab, isShown }: LayerContext<Pictures>) => ({
      aboveWalls: (view) => {
        const traced = createMemo(() => {
          const [plan, now] = [isShown() ? lab.overlay()?.plan : undefined, view()];
          return plan && now ? { paths: trace(plan, now) } : undefined;
        });
        return () => {
          const now = traced();
          return (
            now &&
            ((ctx, { palette }) => {
              draw(ctx, palette, now.paths);
            })
          );
        };
      },
    }),
  };
}

export const OBSTACLES_LAYER = ofPlan(
  { id: 'obstacles', label: 'Obstacles' },
  createObstacles,
  drawObstacles,
);
export const PLAN_LAYER = ofPlan(
  { id: 'plan', label: 'Plan', shownAtFirst: true },
  createPlan,
  drawPlan,
);

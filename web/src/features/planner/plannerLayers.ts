// The layers of ERRT's plan.

import type { PlanLayer } from '../../net/protocol.gen';
import { type BasePicture, drawn, type LayerContext, type MapLayer } from '../../plan/layer';
import { drawObstacles, drawPlan } from './drawPlan';
import type { Pictures } from '../../lab/slices';
import type { Ctx } from '../../plan/sheet';

function ofPlan(
  layer: Pick<MapLayer, 'id' | 'label' | 'shownAtFirst'>,
  draw: (ctx: Ctx, picture: BasePicture, plan: PlanLayer) => void,
): MapLayer {
  return {
    ...layer,
    swatch: ['m-errt'],
    group: 'ERRT',
    create: ({ lab }: LayerContext<Pictures>) => ({
      aboveWalls: drawn(() => lab.overlay()?.plan ?? undefined, draw),
    }),
  };
}

export const OBSTACLES_LAYER = ofPlan({ id: 'obstacles', label: 'Obstacles' }, drawObstacles);
export const PLAN_LAYER = ofPlan({ id: 'plan', label: 'Plan', shownAtFirst: true }, drawPlan);

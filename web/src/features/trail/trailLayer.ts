import { drawTrail } from '../../plan/drawTrail';
import type { Draw, MapLayer, MovingPicture } from '../../plan/layer';
import type { InScene } from '../../scene/sceneLayer';
import { trailsOf } from './trail';

const drawTrails: Draw<MovingPicture> = (ctx, { view, palette, state, history }) => {
  for (const { of, xs_m, ys_m } of trailsOf(state, history)) {
    drawTrail(ctx, view, palette[of === 'tool' ? 'magnet' : 'bead'], xs_m, ys_m);
  }
};

export const TRAIL_LAYER: MapLayer & InScene = {
  id: 'trail',
  label: 'Trails',
  swatch: ['magnet', 'bead'],
  group: 'Motion',
  shownAtFirst: true,
  create: () => ({ moving: () => drawTrails }),
  sceneObject: async () => (await import('./sceneTrails')).sceneTrails,
};

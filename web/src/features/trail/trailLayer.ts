import type { MapLayer } from '../../plan/layer';
import type { InScene } from '../../scene/sceneLayer';
import { drawTrails } from './drawTrails';

export const TRAIL_LAYER: MapLayer & InScene = {
  id: 'trail',
  label: 'Trails',
  swatch: ['m-rl', 'magnet'],
  group: 'Motion',
  shownAtFirst: true,
  create: () => ({ moving: () => drawTrails }),
  sceneObject: async () => (await import('./sceneTrails')).sceneTrails,
};

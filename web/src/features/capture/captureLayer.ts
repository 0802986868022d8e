import type { MapLayer } from '../../plan/layer';
import type { InScene } from '../../scene/sceneLayer';
import { drawCapture } from './drawCapture';

export const CAPTURE_LAYER: MapLayer & InScene = {
  id: 'capture',
  isSensed: true,
  label: 'Capture',
  swatch: ['magnet'],
  group: 'Motion',
  shownAtFirst: true,
  create: () => ({ moving: () => drawCapture }),
  sceneObject: async () => (await import('./sceneCapture')).sceneCapture,
};

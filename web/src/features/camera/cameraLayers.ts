// The layers of the camera: its field of view, and the obstacles in it.

import { drawn, type LayerContext, type MapLayer } from '../../plan/layer';
import type { InScene } from '../../scene/sceneLayer';
import { drawFootprint, drawSensed } from './drawCamera';
import type { Pictures } from '../../lab/slices';

export const CAMERA_LAYER: MapLayer & InScene = {
  id: 'camera',
  isSensed: true,
  label: 'Camera field',
  swatch: ['magnet'],
  group: 'Camera',
  shownAtFirst: true,
  create: () => ({ moving: () => drawFootprint }),
  sceneObject: async () => (await import('./sceneFrustum')).sceneFrustum,
};

export const SENSED_LAYER: MapLayer = {
  id: 'sensed',
  isSensed: true,
  label: 'Sensed',
  swatch: ['sensed'],
  group: 'Camera',
  shownAtFirst: true,
  create: ({ lab }: LayerContext<Pictures>) => ({ aboveWalls: drawn(lab.overlay, drawSensed) }),
};

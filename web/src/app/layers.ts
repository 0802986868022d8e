// The layers of the map in drawing order.

import { CAMERA_LAYER, SENSED_LAYER } from '../features/camera/cameraLayers';
import { CAPTURE_LAYER } from '../features/capture/captureLayer';
import { CHALLENGE_LAYER } from '../features/challenge/challengeLayer';
import { GHOSTS_LAYER } from '../features/compare/ghostsLayer';
import { FIELD_LAYER } from '../features/field/fieldLayer';
import { FLOW_LAYER } from '../features/flow/flowLayer';
import { BLOCKS_LAYER, RECTANGLES_LAYER, SEEN_LAYER } from '../features/observed/observedLayers';
import { OBSTACLES_LAYER, PLAN_LAYER } from '../features/planner/plannerLayers';
import { RECOVERY_LAYER } from '../features/recovery/recoveryLayer';
import { RULERS_LAYER } from '../features/rulers/rulersLayer';
import { SINGULARITY_LAYER } from '../features/singularity/singularityLayer';
import { TRAIL_LAYER } from '../features/trail/trailLayer';
import { VALUE_LAYER } from '../features/values/valueLayer';
import type { MapLayer } from '../plan/layer';
import type { InScene } from '../scene/sceneLayer';

export const MAP_LAYERS: readonly (MapLayer & InScene)[] = [
  SINGULARITY_LAYER,
  VALUE_LAYER,
  RECOVERY_LAYER,
  SEEN_LAYER,
  RULERS_LAYER,
  FLOW_LAYER,
  BLOCKS_LAYER,
  RECTANGLES_LAYER,
  SENSED_LAYER,
  OBSTACLES_LAYER,
  PLAN_LAYER,
  GHOSTS_LAYER,
  CHALLENGE_LAYER,
  FIELD_LAYER,
  TRAIL_LAYER,
  CAMERA_LAYER,
  CAPTURE_LAYER,
];

// The trails on the floor of the 3-D scene.

import { Group } from 'three';
import type { CreateSceneObject } from '../../scene/sceneLayer';
import { Strokes } from '../../scene/strokes';
import { trailsOf } from './trail';

const UP_M = 1.2e-3;
/** More points than this do not change the look of a trail. */
const POINTS = 2000;

export const sceneTrails: CreateSceneObject = (paints) => {
  const style = { width_px: 2, through: true, isCased: true };
  const strokes = [
    new Strokes(paints, 'magnet', POINTS + 1, style),
    new Strokes(paints, 'bead', POINTS + 1, style),
  ] as const;
  const object = new Group();
  for (const one of strokes) object.add(one.object);
  return {
    object,
    place: (state, history) => {
      trailsOf(state, history).forEach(({ xs_m, ys_m }, index) => {
        const trail = strokes[index as 0 | 1].clear();
        const stride = Math.max(1, Math.ceil(xs_m.length / POINTS));
        // Back from the newest point, which is always included.
        for (let i = xs_m.length - 1; i >= 0; i -= stride) {
          const [x, y] = [xs_m[i] ?? 0, ys_m[i] ?? 0];
          if (i === xs_m.length - 1) trail.move(x, y, UP_M);
          else trail.line(x, y, UP_M);
        }
        trail.done();
      });
    },
  };
};

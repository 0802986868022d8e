// What the values of a policy depend on. Pure.

import type { Vec2 } from '../../lab/geometry';
import type { SceneMessage } from '../../net/protocol.gen';

/** What the values depend on. A reset of the trial does not change them. */
export function valueKey(scene: SceneMessage, goal_m: Vec2): string {
  return JSON.stringify([scene.map, scene.parameters.rl_policy, goal_m]);
}

// What this server has, to check a link.

import type { Known } from './experimentLink';
import type { Session, Trial } from './slices';

/** Undefined until all of it has arrived. */
export function knownBy(lab: Session & Trial): Known | undefined {
  const [scene, maps] = [lab.scene(), lab.catalog.maps()];
  return scene && maps && { controllers: scene.controllers, defaults: scene.defaults, maps };
}

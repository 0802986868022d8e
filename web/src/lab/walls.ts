// The walls as the latest state has them. Their outline is requested when they move for the first time on a map.

import { createEffect, createMemo, createSignal, untrack, type Accessor } from 'solid-js';
import type { Lumen } from '../net/protocol.gen';
import { reasonText } from '../net/problem';
import { get } from '../net/requests';
import { sessionPath } from '../net/session';
import { MovedWalls } from './movedWalls';
import type { Basis } from './basis';

/**
 * The walls where they are now; undefined while they are at rest. It is the same object that has moved, and it changes
 * when that is visible.
 */
export function createWalls(
  lab: Pick<Basis, 'session' | 'connection' | 'scene' | 'state' | 'notify'>,
  request: (path: string) => Promise<Lumen> = get,
): Accessor<MovedWalls | undefined> {
  const [walls, setWalls] = createSignal<MovedWalls>();
  let requests = 0;
  const load = async (): Promise<void> => {
    requests += 1;
    const number = requests;
    try {
      const lumen = await request(sessionPath(lab.session, 'lumen'));
      if (number === requests) setWalls(new MovedWalls(lumen));
    } catch (reason) {
      if (number !== requests) return;
      lab.notify('workspace', `The moving walls cannot be drawn: ${reasonText(reason)}`);
    }
  };
  // A request that failed is repeated when the walls move again after a rest, or after a lost connection.
  const wanted = createMemo(() => {
    const isMoving = lab.connection().kind === 'live' && lab.state()?.wave_m !== undefined;
    return isMoving ? lab.scene()?.map : undefined;
  });
  createEffect(() => {
    const map = wanted();
    if (map !== undefined && untrack(walls)?.map !== map) void load();
  });
  let hasMoved = false;
  return createMemo(
    () => {
      const [now, scene, state] = [walls(), lab.scene(), lab.state()];
      if (!scene || !state?.wave_m || now?.map !== scene.map) return undefined;
      const [x, y] = state.bead_m;
      hasMoved = now.move(state.wave_m, { at_m: [x, y], radius_m: scene.bead_radius_m });
      return now;
    },
    undefined,
    { equals: (before, after) => before === after && !(after && hasMoved) },
  );
}

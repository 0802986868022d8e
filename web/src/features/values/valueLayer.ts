// The layer of values: asked for while it is shown.

import { createMemo, type Accessor } from 'solid-js';
import { createAnswer } from '../../net/requests';
import type { Lab } from '../../lab/lab';
import type { ValueMap, ValueQuery } from '../../net/protocol.gen';
import { sessionPath } from '../../net/session';
import { valueKey } from './value';
import type { Vec2 } from '../../lab/geometry';

export interface ValueLayer {
  /** Of this goal, map and policy: values of others would mislead, and a first look takes seconds. */
  readonly map: Accessor<ValueMap | undefined>;
  readonly error: Accessor<string | undefined>;
}

export function createValueLayer(
  lab: Lab,
  goal: Accessor<Vec2 | undefined>,
  shown: Accessor<boolean>,
): ValueLayer {
  const key = createMemo(() => {
    const [scene, goal_m] = [lab.scene(), goal()];
    return scene && goal_m && shown() ? valueKey(scene, goal_m) : undefined;
  });
  const answer = createAnswer<ValueQuery, ValueMap>(
    sessionPath(lab.session, 'values'),
    () => {
      const goal_m = goal();
      const asks = key() !== undefined && lab.link().kind === 'live';
      return asks && goal_m ? { goal_m: [goal_m[0], goal_m[1]] } : undefined;
    },
    { key: () => key() ?? '' },
  );
  const isNow = createMemo(() => key() !== undefined && answer().key === key());
  const error = createMemo(() => (isNow() ? answer().error : undefined));
  return {
    map: createMemo(() => (isNow() && error() === undefined ? answer().data : undefined)),
    error,
  };
}

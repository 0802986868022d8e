// The layer of the attractor's flow: asked for while it is shown.

import { createMemo, untrack, type Accessor } from 'solid-js';
import { type Answer, createAnswer } from '../../net/requests';
import type { Lab } from '../../lab/lab';
import type { FlowField, FlowQuery } from '../../net/protocol.gen';
import { sessionPath } from '../../net/session';
import { createFlow, type Flow } from './drawFlow';
import { flowKey, flowQuery } from './flow';
import type { Vec2 } from '../../lab/geometry';

/** While the camera shows new things, the field is another ten times a second: costly, and too fast to read. */
const ASKED_PER_S = 4;

export interface FlowLayer {
  readonly answer: Accessor<Answer<FlowField>>;
  /** What is to be drawn. */
  readonly flow: Accessor<Flow | undefined>;
}

export function createFlowLayer(
  lab: Lab,
  goal: Accessor<Vec2 | undefined>,
  shown: Accessor<boolean>,
): FlowLayer {
  const asks = createMemo(() => shown() && goal() !== undefined && lab.link().kind === 'live');
  const answer = createAnswer<FlowQuery, FlowField>(
    sessionPath(lab.session, 'flow'),
    () => {
      const [scene, seen] = [lab.scene(), lab.seen()];
      return asks() && scene && seen ? flowQuery(scene, seen) : undefined;
    },
    {
      key: () => {
        const [scene, at] = [lab.scene(), goal()];
        return scene && at ? flowKey(scene, at) : '';
      },
      perS: ASKED_PER_S,
    },
  );
  const drawn = createMemo(() => {
    const field = answer().data;
    // What it was answered for: a later goal, or more that is seen, brings its own field.
    const [at, seen] = untrack(() => [goal(), lab.seen()] as const);
    return field && at && seen && field.velocity_m_s.length > 0
      ? createFlow(field, at, seen)
      : undefined;
  });
  return { answer, flow: () => (asks() && lab.seen() ? drawn() : undefined) };
}

// The attractor flow layer. Its data is requested while it is shown.

import { Show, createMemo, untrack } from 'solid-js';
import type { FlowField, FlowQuery } from '../../net/protocol.gen';
import { createAnswer } from '../../net/requests';
import { sessionPath } from '../../net/session';
import { drawn, type LayerContext, type MapLayer } from '../../plan/layer';
import { FlowLegend } from './FlowLegend';
import { createFlow, drawFlow } from './drawFlow';
import { flowKey, flowQuery } from './flow';
import type { Pictures, Session, Trial } from '../../lab/slices';

/** New camera images change the field ten times per second, which is costly and too fast to read. */
const REQUESTS_PER_S = 4;

export const FLOW_LAYER: MapLayer = {
  id: 'flow',
  label: 'Attractor flow',
  swatch: ['m-attractor'],
  group: 'Attractor',
  create: ({ lab, isShown }: LayerContext<Session & Trial & Pictures>) => {
    const asks = createMemo(
      () => isShown() && lab.goal() !== undefined && lab.connection().kind === 'live',
    );
    const answer = createAnswer<FlowQuery, FlowField>(
      sessionPath(lab.session, 'flow'),
      () => {
        const [scene, seen] = [lab.scene(), lab.obstacleMap()];
        return asks() && scene && seen ? flowQuery(scene, seen) : undefined;
      },
      {
        key: () => {
          const [scene, goal_m] = [lab.scene(), lab.goal()];
          return scene && goal_m ? flowKey(scene, goal_m) : '';
        },
        perS: REQUESTS_PER_S,
      },
    );
    const answered = createMemo(() => {
      const field = answer().data;
      // The state that the field belongs to. A new goal or a larger observed area gets a new field.
      const [goal_m, seen] = untrack(() => [lab.goal(), lab.obstacleMap()] as const);
      return field && goal_m && seen && field.velocity_m_s.length > 0
        ? createFlow(field, goal_m, seen)
        : undefined;
    });
    const flow = () => (asks() && lab.obstacleMap() ? answered() : undefined);
    return {
      aboveWalls: drawn(flow, drawFlow),
      legend: () => (
        <Show when={lab.scene()}>
          {(scene) => (
            <FlowLegend
              answer={answer()}
              flow={flow()}
              hasGoal={lab.goal() !== undefined}
              law={scene().parameters.attractor_law}
            />
          )}
        </Show>
      ),
    };
  },
};

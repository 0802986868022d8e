// The value layer. Its data is requested while it is shown.

import { createMemo } from 'solid-js';
import type { ValueMap, ValueQuery } from '../../net/protocol.gen';
import { createAnswer } from '../../net/requests';
import { sessionPath } from '../../net/session';
import { drawn, type LayerContext, type MapLayer } from '../../plan/layer';
import { ValueLegend } from './ValueLegend';
import { RAMPS } from '../../plan/colourRamp';
import { createValues, drawArrows, drawColours } from '../../plan/drawValues';
import { valueKey } from './value';
import type { Pictures, Session, Trial } from '../../lab/slices';
import { palette } from '../../ui/palette';

const REQUESTS_PER_S = 4;

export const VALUE_LAYER: MapLayer = {
  id: 'value',
  label: 'Value',
  swatch: RAMPS.value,
  group: 'RL',
  create: ({ lab, isShown }: LayerContext<Session & Trial & Pictures>) => {
    const key = createMemo(() => {
      const [scene, goal_m] = [lab.scene(), lab.goal()];
      return scene && goal_m && isShown() ? valueKey(scene, goal_m) : undefined;
    });
    // The values of a policy with a memory change with each image that shows more.
    const remembers = (): boolean => answer().data?.has_memory === true;
    const answer = createAnswer<ValueQuery, ValueMap>(
      sessionPath(lab.session, 'values'),
      () => {
        const goal_m = lab.goal();
        const asks = key() !== undefined && lab.connection().kind === 'live';
        if (!asks || !goal_m) return undefined;
        const query: ValueQuery = { goal_m: [goal_m[0], goal_m[1]] };
        const seen = remembers() ? lab.obstacleMap()?.number : undefined;
        return seen === undefined ? query : { ...query, seen };
      },
      { key: () => key() ?? '', perS: REQUESTS_PER_S },
    );
    // Only values of this goal, map and policy: the first answer takes seconds, and old values would mislead.
    const isNow = createMemo(() => key() !== undefined && answer().key === key());
    const error = createMemo(() => (isNow() ? answer().error : undefined));
    const map = createMemo(() => (isNow() && error() === undefined ? answer().data : undefined));
    const values = createMemo(() => {
      const now = map();
      return now && createValues(now, palette());
    });
    return {
      belowWalls: drawn(values, (ctx, { view }, now) => {
        drawColours(ctx, view, now);
        drawArrows(ctx, view, now);
      }),
      legend: () => <ValueLegend map={map()} error={error()} hasGoal={lab.goal() !== undefined} />,
    };
  },
};

// The singularity layer. Its data is requested while it is shown.

import { Show, createMemo } from 'solid-js';
import type { WorkspaceMap, WorkspaceQuery } from '../../net/protocol.gen';
import { createAnswer } from '../../net/requests';
import { drawn, type LayerContext, type MapLayer } from '../../plan/layer';
import { RAMPS } from '../../plan/colourRamp';
import { HeatLegend } from './HeatLegend';
import { createHeat, drawHeat } from './drawHeat';
import { workspaceQuery } from './heat';
import type { Session, Trial } from '../../lab/slices';
import { palette } from '../../ui/palette';

export const SINGULARITY_LAYER: MapLayer = {
  id: 'singularity',
  label: 'Singularity',
  swatch: RAMPS.heat,
  group: 'Arm',
  unavailable: (lab: Trial) =>
    lab.scene()?.positioner === 'planar_stage'
      ? 'The planar stage has no arm, so it has no singularities.'
      : undefined,
  create: ({ lab, isShown }: LayerContext<Session & Trial>) => {
    const question = createMemo<WorkspaceQuery | undefined>(() => {
      const [scene, parameters] = [lab.scene(), lab.edits.shown()];
      return isShown() && scene && parameters ? workspaceQuery(scene, parameters) : undefined;
    });
    const answer = createAnswer<WorkspaceQuery, WorkspaceMap>('/api/kinematics/workspace', () =>
      lab.connection().kind === 'live' ? question() : undefined,
    );
    const heat = createMemo(() => {
      const map = answer().data;
      return map && createHeat(map, palette());
    });
    return {
      belowWalls: drawn(() => question() && heat(), drawHeat),
      legend: () => (
        <Show when={question()}>
          <HeatLegend answer={answer()} />
        </Show>
      ),
    };
  },
};

// The magnetic field layer. Its data is requested while it is shown; it moves with the tool.

import { createMemo } from 'solid-js';
import type { Plane, PlaneQuery } from '../../net/protocol.gen';
import { createAnswer } from '../../net/requests';
import type { LayerContext, MapLayer } from '../../plan/layer';
import { RAMPS } from '../../plan/colourRamp';
import { FieldLegend } from './FieldLegend';
import { createFieldPicture, drawField } from './drawPlane';
import { HALF_SIDE_M, planeQuery } from './plane';
import type { Session, Trial } from '../../lab/slices';
import { palette } from '../../ui/palette';

export const FIELD_LAYER: MapLayer = {
  id: 'field',
  label: 'Field and pull',
  swatch: RAMPS.field,
  group: 'Motion',
  create: ({ lab, isShown }: LayerContext<Session & Trial>) => {
    const answer = createAnswer<PlaneQuery, Plane>('/api/magnetics/plane', () => {
      const parameters = lab.edits.shown();
      const asks = isShown() && lab.connection().kind === 'live';
      return asks && parameters ? planeQuery(parameters) : undefined;
    });
    const field = createMemo(() => {
      const plane = answer().data;
      return plane && isShown() ? createFieldPicture(plane, palette()) : undefined;
    });
    return {
      underTool: createMemo(() => {
        const now = field();
        return (
          now && {
            halfSide_m: HALF_SIDE_M,
            draw: (ctx, view, palette) => drawField(ctx, view, palette, now),
          }
        );
      }),
      legend: () => <FieldLegend answer={answer()} />,
    };
  },
};

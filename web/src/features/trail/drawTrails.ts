// The trail of the bead in the look of the controller that carried it, and the thin one of the magnet.

import { CARRIERS, type Controller } from '../../ui/controllers';
import { lineOf, strokeCased } from '../../plan/marks';
import type { Draw, MovingPicture } from '../../plan/layer';
import { drawTrail } from '../../plan/drawTrail';
import { pxFromWorld } from '../../plan/transform';

const LINE_PX = 3.4;
/** Points of a line that are nearer to each other do not change its look. */
const APART_PX = 1.2;

/** The controller that carried at a sample; undefined while the magnet did not hold the bead. */
const carrierAt = (controller: number, mode: number): Controller | undefined =>
  mode === 1 ? undefined : CARRIERS[controller];

export const drawTrails: Draw<MovingPicture> = (ctx, { view, palette, state, history }) => {
  const { tool_x_m, tool_y_m, bead_x_m, bead_y_m, controller, mode, tick } = history.window(
    0,
    state.sim_time_s,
  );
  drawTrail(ctx, view, palette.magnet, tool_x_m, tool_y_m);
  const last = bead_x_m.length - 1;
  let path = new Path2D();
  let carrier: Controller | undefined;
  let isEmpty = true;
  let [fromX, fromY] = [NaN, NaN];
  const finish = (): void => {
    const line = carrier
      ? lineOf(palette, carrier, LINE_PX)
      : { colour: palette.magnet, width_px: 1.4, dash: [2, 3] };
    if (!isEmpty) strokeCased(ctx, palette, line, path);
  };
  // Always the same points, so that dashes do not move, and the newest one.
  for (let i = 0; i <= last; i++) {
    const now = carrierAt(controller[i] ?? 0, mode[i] ?? 0);
    const isOther = now !== carrier;
    const [x, y] = pxFromWorld(view, [bead_x_m[i] ?? 0, bead_y_m[i] ?? 0]);
    const isFar = !(Math.abs(x - fromX) + Math.abs(y - fromY) < APART_PX);
    const isJump = i > 0 && history.hasJump(tick[i - 1] ?? 0, tick[i] ?? 0);
    if (!isFar && !isOther && !isJump && i < last) continue;
    if (isOther) {
      finish();
      path = new Path2D();
      carrier = now;
      isEmpty = true;
      path.moveTo(...(Number.isNaN(fromX) ? ([x, y] as const) : ([fromX, fromY] as const)));
    }
    if (i === 0 || isJump) path.moveTo(x, y);
    else {
      path.lineTo(x, y);
      isEmpty = false;
    }
    [fromX, fromY] = [x, y];
  }
  finish();
};

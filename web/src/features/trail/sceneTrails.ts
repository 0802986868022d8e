// The trails on the floor of the 3-D scene, in the same looks as on the map.

import { Object3D } from 'three';
import type { Column } from '../../lab/history';
import type { CreateSceneObject } from '../../scene/sceneLayer';
import { Strokes } from '../../scene/strokes';
import { CARRIERS, type Controller, dashOf, LOOKS } from '../../ui/controllers';

const UP_M = 1.2e-3;
/** More points than this do not change the look of a trail. */
const POINTS = 2000;
/** Pieces of dashes. */
const CAPACITY = 3 * POINTS;
const LINE_PX = 3;
const THIN_PX = 1.4;
const CASED_PX = LINE_PX + 2.5;
/** Size of a pixel of the dashes. */
const PX_M = 1 / 800;
/** Of the trail without a carrier, in pixels. */
const LOOSE_DASH = [2, 3];

/** Draws the parts of a way that lie in dashes. */
class Dashes {
  /** Length of the way so far. */
  private at_m = 0;
  private readonly parts_m: readonly number[];
  private readonly period_m: number;

  constructor(
    private readonly strokes: Strokes,
    dash_px: readonly number[],
  ) {
    this.parts_m = dash_px.map((part_px) => part_px * PX_M);
    this.period_m = this.parts_m.reduce((sum, part_m) => sum + part_m, 0);
  }

  line(x: number, y: number, toX: number, toY: number): void {
    const { strokes, parts_m, period_m } = this;
    const length_m = Math.hypot(toX - x, toY - y);
    const end_m = this.at_m + length_m;
    const point = (at_m: number): [number, number, number] => {
      const share = length_m > 0 ? 1 - (end_m - at_m) / length_m : 0;
      return [x + share * (toX - x), y + share * (toY - y), UP_M];
    };
    let from_m = period_m > 0 ? Math.floor(this.at_m / period_m) * period_m : this.at_m;
    if (period_m === 0) strokes.move(x, y, UP_M).line(toX, toY, UP_M);
    while (period_m > 0 && from_m < end_m) {
      parts_m.forEach((part_m, i) => {
        const [start_m, stop_m] = [Math.max(from_m, this.at_m), Math.min(from_m + part_m, end_m)];
        if (i % 2 === 0 && start_m < stop_m) strokes.move(...point(start_m)).line(...point(stop_m));
        from_m += part_m;
      });
    }
    this.at_m = end_m;
  }
}

export const sceneTrails: CreateSceneObject = (paints) => {
  const object = new Object3D();
  const strokesOf = (...look: [name: 'case' | 'magnet' | 'm-rl', width_px: number]): Strokes => {
    const strokes = new Strokes(paints, look[0], CAPACITY, { width_px: look[1], through: true });
    object.add(strokes.object);
    return strokes;
  };
  const casing = strokesOf('case', CASED_PX);
  const tool = strokesOf('magnet', THIN_PX);
  const looks = new Map<Controller | undefined, Strokes>();
  const lookOf = (carrier: Controller | undefined): Strokes => {
    const known = looks.get(carrier);
    if (known) return known;
    const mark = carrier ? (LOOKS[carrier].mark as 'm-rl') : 'magnet';
    const strokes = strokesOf(mark, carrier ? LINE_PX : THIN_PX);
    looks.set(carrier, strokes);
    return strokes;
  };
  return {
    object,
    place: (state, history) => {
      for (const strokes of [casing, tool, ...looks.values()]) strokes.clear();
      const now = history.window(0, state.sim_time_s);
      const last = now.tick.length - 1;
      const stride = Math.max(1, Math.ceil(now.tick.length / POINTS));
      const at = (name: Column, k: number): number => now[name][k] ?? 0;
      const dashes = new Map<Controller | undefined, Dashes>();
      // Always the same points, so that dashes do not move, and the newest one.
      for (let before = 0; before < last; before += stride) {
        const i = Math.min(last, before + stride);
        tool.move(at('tool_x_m', before), at('tool_y_m', before), UP_M);
        tool.line(at('tool_x_m', i), at('tool_y_m', i), UP_M);
        const [x, y] = [at('bead_x_m', before), at('bead_y_m', before)];
        const [toX, toY] = [at('bead_x_m', i), at('bead_y_m', i)];
        const carrier = at('mode', i) === 1 ? undefined : CARRIERS[at('controller', i)];
        const way =
          dashes.get(carrier) ??
          new Dashes(lookOf(carrier), carrier ? dashOf(carrier, LINE_PX) : LOOSE_DASH);
        dashes.set(carrier, way);
        if (history.hasJump(at('tick', before), at('tick', i))) continue;
        casing.move(x, y, UP_M).line(toX, toY, UP_M);
        way.line(x, y, toX, toY);
      }
      for (const strokes of [casing, tool, ...looks.values()]) strokes.done();
    },
  };
};

// What lies on the table and moves seldom: the map and the layers that the camera and the controllers tell.
// The plan draws it below what moves, the scene on its floor.

import { createMemo, type Accessor } from 'solid-js';
import type { Lab } from '../lab/lab';
import type { Palette } from '../ui/palette';
import type { ComparisonMessage, OverlayMessage, SceneMessage } from '../net/protocol.gen';
import type { View } from './transform';
import type { Flow } from '../features/flow/drawFlow';
import type { Heat } from '../features/singularity/drawHeat';
import { wallPath } from './drawMap';
import { createPlan, type Plan } from '../features/planner/drawPlan';
import type { FieldPicture } from '../features/field/drawPlane';
import type { Seen } from '../features/observed/drawObserved';
import { createValues, type Values } from '../features/values/drawValue';
import type { Fields } from '../app/fields';
import type { Layer } from '../lab/layers';

export interface Ground {
  readonly view: View;
  readonly palette: Palette;
  readonly scene: SceneMessage;
  readonly walls: Path2D;
  /** What the camera tells, when a layer shows it. */
  readonly overlay: OverlayMessage | undefined;
  /** The layer of singularities, when it is shown. */
  readonly heat: Heat | undefined;
  /** What the policy thinks of each place, when it is shown. */
  readonly values: Values | undefined;
  /** What the camera has shown, when it is shown. */
  readonly seen: Seen | undefined;
  /** What ERRT plans, when it does. */
  readonly plan: Plan | undefined;
  /** The magnet's field, when it is shown: it goes with the tool. */
  readonly field: FieldPicture | undefined;
  /** The attractor's flow, when it is shown. */
  readonly flow: Flow | undefined;
  /** A fork, and the tick at which its branches are shown. */
  readonly ghosts: { readonly comparison: ComparisonMessage; readonly tick: number } | undefined;
  readonly layers: ReadonlySet<Layer>;
}

const OF_THE_CAMERA: readonly Layer[] = ['sensed', 'blocks', 'rectangles'];

export function createGround(
  lab: Lab,
  layers: Accessor<ReadonlySet<Layer>>,
  palette: Accessor<Palette>,
  fields: Fields,
  view: Accessor<View | undefined>,
): Accessor<Ground | undefined> {
  const walls = createMemo(() => {
    const now = view();
    const scene = lab.scene();
    return now && scene ? wallPath(scene.walls, now) : undefined;
  });
  const plan = createMemo(() => {
    const isShown = layers().has('plan') || layers().has('obstacles');
    const layer = isShown ? lab.overlay()?.plan : undefined;
    const now = view();
    return layer && now ? createPlan(layer, now) : undefined;
  });
  const values = createMemo(() => {
    const map = fields.value.map();
    const now = view();
    return map && now ? createValues(map, palette(), now) : undefined;
  });
  const ghosts = createMemo(() => {
    const comparison = lab.ghosts.comparison();
    return comparison && layers().has('ghosts')
      ? { comparison, tick: lab.ghosts.tick() }
      : undefined;
  });
  return createMemo(() => {
    const scene = lab.scene();
    const now = view();
    const wallsNow = walls();
    if (!scene || !now || !wallsNow) return undefined;
    return {
      view: now,
      palette: palette(),
      scene,
      walls: wallsNow,
      overlay: OF_THE_CAMERA.some((layer) => layers().has(layer)) ? lab.overlay() : undefined,
      heat: fields.heat(),
      values: values(),
      seen: fields.seen(),
      plan: plan(),
      field: fields.field(),
      flow: fields.flow.flow(),
      ghosts: ghosts(),
      layers: layers(),
    };
  });
}

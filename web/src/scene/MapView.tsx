// The map: the plan view or the 3-D view, with a flight of the camera between the two.

import { Show, createEffect, createSignal, untrack, type JSX } from 'solid-js';
import type { TableView } from '../lab/geometry';
import type { LiveLayer, MapLayer } from '../plan/layer';
import { PlanView, type SurfaceProps } from '../plan/PlanView';
import type { InScene } from './sceneLayer';
import { ScenePanel } from './ScenePanel';

export function MapView(
  props: SurfaceProps & {
    layers: readonly LiveLayer<MapLayer & InScene>[];
    mode: 'plan' | 'scene';
    /** Called by a button where the 3-D view cannot be shown. */
    onPlan: () => void;
    /** Shift of the 3-D picture to the right, as a share of its width. */
    shift?: number;
  },
): JSX.Element {
  const [shown, setShown] = createSignal(untrack(() => props.mode));
  const [plan, setPlan] = createSignal<TableView>();
  createEffect(() => {
    if (props.mode === 'scene') setShown('scene');
  });
  createEffect(() => {
    const view = props.interaction.view();
    if (view && untrack(shown) === 'plan') setPlan(() => view);
  });
  return (
    <Show when={shown() === 'scene'} fallback={<PlanView {...props} />}>
      <ScenePanel
        {...props}
        plan={untrack(plan)}
        isLeaving={props.mode === 'plan'}
        onLeft={() => setShown('plan')}
      />
    </Show>
  );
}

// The map: the plan view or the 3-D view, with a flight of the camera between the two.

import { Show, createEffect, createSignal, untrack, type JSX } from 'solid-js';
import type { LiveLayer, MapLayer } from '../plan/layer';
import { PlanView, type SurfaceProps } from '../plan/PlanView';
import type { Size } from '../ui/size';
import type { PlanPicture } from './flight';
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
    /** Share of its height that stays free below. */
    below?: number;
  },
): JSX.Element {
  const [shown, setShown] = createSignal(untrack(() => props.mode));
  const [plan, setPlan] = createSignal<PlanPicture>();
  createEffect(() => {
    if (props.mode === 'scene') setShown('scene');
  });
  const [size, setSize] = createSignal<Size>();
  createEffect(() => {
    const [view, sizeNow] = [props.interaction.view(), size()];
    if (view && sizeNow && untrack(shown) === 'plan') setPlan({ ...view, size: sizeNow });
  });
  return (
    <Show
      when={shown() === 'scene'}
      fallback={
        <PlanView
          {...props}
          onPicture={(picture) => {
            if (picture) setSize(picture.size);
            props.onPicture?.(picture);
          }}
        />
      }
    >
      <ScenePanel
        {...props}
        plan={untrack(plan)}
        isLeaving={props.mode === 'plan'}
        onLeft={() => setShown('plan')}
      />
    </Show>
  );
}

// Details of the active controller.

import { Show, type JSX } from 'solid-js';
import { PlannerFacts } from '../features/planner/PlannerFacts';
import { ValueFans } from '../features/values/ValueFans';
import type { Pictures, Trial } from '../lab/slices';

export function ControllerFacts(props: { lab: Trial & Pictures }): JSX.Element {
  const { lab } = props;
  return (
    <>
      <Show when={lab.overlay()?.plan}>
        {(plan) => (
          <Show when={lab.state()}>
            {(state) => <PlannerFacts plan={plan()} state={state()} />}
          </Show>
        )}
      </Show>
      <Show when={lab.overlay()?.judgement}>
        {(judgement) => (
          <Show when={lab.scene()}>
            {(scene) => <ValueFans judgement={judgement()} map={scene().map} />}
          </Show>
        )}
      </Show>
    </>
  );
}

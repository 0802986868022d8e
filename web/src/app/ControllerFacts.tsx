// Details of the active controller.

import { Match, Show, Switch, type JSX } from 'solid-js';
import { PlannerFacts } from '../features/planner/PlannerFacts';
import { ProgramFacts } from '../features/program/ProgramFacts';
import { RobotFacts } from '../features/robot/RobotFacts';
import { ValueFans } from '../features/values/ValueFans';
import type { ByHand, Panels, Pictures, Trial } from '../lab/slices';
import { YouFacts } from '../features/steer/YouFacts';
import type { ControllerName } from '../net/protocol.gen';
import './ControllerFacts.css';

const NONE_YET: Record<ControllerName, string | undefined> = {
  rl: 'The policy has not decided anything yet.',
  errt: 'There is no plan yet.',
  replanner: 'There is no plan yet.',
  attractor: undefined,
  you: undefined,
  program: undefined,
  robot: undefined,
};

export function ControllerFacts(props: { lab: Trial & Pictures & ByHand & Panels }): JSX.Element {
  const { lab } = props;
  return (
    <Show when={lab.state()}>
      {(state) => (
        <>
          <Show when={state().controller === 'you'}>
            <YouFacts lab={lab} />
          </Show>
          <Show when={state().controller === 'program'}>
            <ProgramFacts program={state().program} />
          </Show>
          <Show when={state().controller === 'robot' && state().robot}>
            {(robot) => <RobotFacts robot={robot()} />}
          </Show>
          <Show when={NONE_YET[state().controller]}>
            {(none) => (
              <div class="controller-facts" data-controller={state().controller}>
                <Switch fallback={<p class="none-yet">{none()}</p>}>
                  <Match when={lab.overlay()?.plan}>
                    {(plan) => <PlannerFacts plan={plan()} state={state()} />}
                  </Match>
                  <Match when={lab.overlay()?.judgement}>
                    {(judgement) => (
                      <Show when={lab.scene()}>
                        {(scene) => <ValueFans judgement={judgement()} map={scene().map} />}
                      </Show>
                    )}
                  </Match>
                </Switch>
              </div>
            )}
          </Show>
        </>
      )}
    </Show>
  );
}

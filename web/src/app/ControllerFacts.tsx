// What the active controller sees and decides.

import { Match, Show, Switch, type JSX } from 'solid-js';
import { CameraFacts } from '../features/camera/CameraFacts';
import { CameraSight } from '../features/camera/CameraSight';
import { PlannerFacts } from '../features/planner/PlannerFacts';
import { ProgramFacts } from '../features/program/ProgramFacts';
import { RobotFacts } from '../features/robot/RobotFacts';
import { YouFacts } from '../features/steer/YouFacts';
import { ValueFans, ValueWords } from '../features/values/ValueFans';
import type { ByHand, Notices, Panels, Pictures, Trial } from '../lab/slices';

type FactsLab = Trial & Pictures & Notices & ByHand & Panels;

export function ControllerFacts(props: { lab: FactsLab }): JSX.Element {
  const { lab } = props;
  const judgement = () => lab.overlay()?.judgement ?? undefined;
  return (
    <Show when={lab.state()}>
      {(state) => {
        const isBy = (...controllers: string[]): boolean =>
          controllers.includes(state().controller);
        return (
          <>
            <CameraSight lab={lab}>
              <Switch
                fallback={
                  <CameraFacts overlay={lab.overlay()} sensesObstacles={isBy('attractor')} />
                }
              >
                <Match when={isBy('rl')}>
                  <ValueFans judgement={judgement()} />
                </Match>
                <Match when={isBy('errt', 'replanner')}>
                  <PlannerFacts plan={lab.overlay()?.plan ?? undefined} state={state()} />
                </Match>
              </Switch>
            </CameraSight>
            <Switch>
              <Match when={isBy('rl')}>
                <ValueWords judgement={judgement()} map={lab.scene()?.map ?? ''} />
              </Match>
              <Match when={isBy('you')}>
                <YouFacts lab={lab} />
              </Match>
              <Match when={isBy('program')}>
                <ProgramFacts program={state().program} />
              </Match>
              <Match when={isBy('robot') && state().robot}>
                {(robot) => <RobotFacts robot={robot()} />}
              </Match>
            </Switch>
          </>
        );
      }}
    </Show>
  );
}

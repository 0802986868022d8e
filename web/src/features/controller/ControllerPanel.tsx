// Who steers, what it does, and why it moves as it does.

import { Show, type JSX } from 'solid-js';
import { isLedFromOutside } from '../../lab/outside';
import {
  CONTROLLER_HELP,
  CONTROLLER_LABELS,
  controllerLabel,
  policyName,
} from '../../lab/parameters';
import type { Events, Panels, Session, Trial } from '../../lab/slices';
import type { StateMessage } from '../../net/protocol.gen';
import { Glyph } from '../../ui/Glyph';
import { troubleWords } from '../../words/facts';
import { SwitchingLaw } from './SwitchingLaw';
import './ControllerPanel.css';

/** What the controller does, or what keeps it from the goal. */
function About(props: { state: StateMessage; policy: string }): JSX.Element {
  const trouble = (): string | undefined => {
    const { controller, trouble } = props.state;
    return trouble === null ? undefined : troubleWords(CONTROLLER_LABELS[controller], trouble);
  };
  const help = (): string => {
    const { controller } = props.state;
    if (controller !== 'rl' || props.policy === 'auto') return CONTROLLER_HELP[controller];
    return `The policy “${policyName(props.policy)}”: from the camera’s picture it judges four directions, step by step.`;
  };
  return (
    <p class="about-controller" classList={{ trouble: trouble() !== undefined }}>
      {trouble() ?? help()}
    </p>
  );
}

/** The children show details of the active controller. */
export function ControllerPanel(props: {
  lab: Session & Trial & Events & Panels;
  children: JSX.Element;
}): JSX.Element {
  const { lab } = props;
  return (
    <Show when={lab.scene()}>
      {(scene) => (
        <Show when={lab.state()}>
          {(state) => (
            <div class="now">
              <div class="now-columns">
                <section class="controller">
                  <h2>
                    <Glyph of={state().controller} />
                    {controllerLabel({
                      controller: state().controller,
                      program: state().program?.name ?? null,
                    })}
                  </h2>
                  <About state={state()} policy={scene().parameters.rl_policy} />
                  {props.children}
                </section>
                <Show when={!isLedFromOutside(state())}>
                  <div class="law">
                    <SwitchingLaw lab={lab} state={state()} scene={scene()} />
                  </div>
                </Show>
              </div>
            </div>
          )}
        </Show>
      )}
    </Show>
  );
}

// The active controller, its reasons, and its parameters.

import { For, Show, createMemo, type JSX } from 'solid-js';
import { troubleWords } from '../../words/facts';
import { CONTROLLERS, CONTROLLER_HELP, CONTROLLER_LABELS, policyName } from '../../lab/parameters';
import type { ControllerName, StateMessage } from '../../net/protocol.gen';
import { createPrograms } from '../../lab/programs';
import { PlaceNotice } from '../../lab/PlaceNotice';
import { isLedFromOutside } from '../../lab/outside';
import { ParameterForm } from './ParameterForm';
import { SwitchingLaw } from './SwitchingLaw';
import type { Notices, Session, Trial } from '../../lab/slices';
import { createPending } from '../../ui/pending';
import { shownName } from '../../ui/name';
import './ControllerPanel.css';

/** Something that can be chosen: one of Ferry's own controllers, or a program. */
interface Choice {
  readonly controller: ControllerName;
  readonly program?: string;
}

const keyOf = ({ controller, program }: Choice): string => program ?? controller;

function ControllerChoice(props: {
  lab: Session & Trial;
  names: readonly ControllerName[];
}): JSX.Element {
  const { lab } = props;
  const program = createMemo(() => {
    const state = lab.state();
    return state?.controller === 'program' ? state.program?.name : undefined;
  });
  const names = createPrograms(lab.catalog, program);
  const chosen = createPending<Choice>(
    () => {
      const [controller, name] = [lab.state()?.controller ?? 'rl', program()];
      return name === undefined ? { controller } : { controller, program: name };
    },
    (choice) => lab.send('controller', { type: 'select_controller', ...choice }),
  );
  const radio = (choice: Choice): JSX.Element => {
    const isChosen = (): boolean => keyOf(chosen.value()) === keyOf(choice);
    return (
      <label title={CONTROLLER_HELP[choice.controller]}>
        <input
          type="radio"
          name="controller"
          value={keyOf(choice)}
          checked={isChosen()}
          aria-busy={isChosen() && chosen.isPending()}
          disabled={!lab.canOperate()}
          onChange={() => chosen.choose(choice)}
        />
        {shownName(choice.program ?? CONTROLLER_LABELS[choice.controller])}
      </label>
    );
  };
  return (
    <fieldset class="choice" role="radiogroup" aria-label="Controller">
      <For each={props.names}>{(controller) => radio({ controller })}</For>
      {/* It takes the arm by itself; a choice only takes it back. */}
      <Show when={lab.state()?.controller === 'robot'}>{radio({ controller: 'robot' })}</Show>
      <For each={names()}>{(program) => radio({ controller: 'program', program })}</For>
    </fieldset>
  );
}

/** What the controller does, or what keeps it from the goal. */
function About(props: { state: StateMessage; policy: string }): JSX.Element {
  const trouble = (): string | undefined => {
    const { controller, trouble } = props.state;
    return trouble === null ? undefined : troubleWords(CONTROLLER_LABELS[controller], trouble);
  };
  const help = (): string => {
    const { controller } = props.state;
    if (controller !== 'rl' || props.policy === 'auto') return CONTROLLER_HELP[controller];
    return `RL with the policy “${policyName(props.policy)}”: from the camera's pictures it judges four directions, step by step.`;
  };
  return (
    <>
      <p class="about-controller" classList={{ trouble: trouble() !== undefined }}>
        {trouble() ?? help()}
      </p>
      {/* Below these, their own facts need the room. */}
      <Show when={!['you', 'robot'].includes(props.state.controller)}>
        <div class="about-others">
          <For each={CONTROLLERS.filter((name) => name !== props.state.controller)}>
            {(name) => <p>{CONTROLLER_HELP[name]}</p>}
          </For>
        </div>
      </Show>
    </>
  );
}

/** The children show details of the active controller. What is `above` does not move when another one is active. */
export function ControllerPanel(props: {
  lab: Session & Trial & Notices;
  above: JSX.Element;
  children: JSX.Element;
}): JSX.Element {
  const { lab } = props;
  return (
    <section class="panel controller">
      <header class="panel-head">
        <h2>Controller</h2>
        <Show when={lab.scene()}>
          {(scene) => <ControllerChoice lab={lab} names={scene().controllers} />}
        </Show>
      </header>
      {props.above}
      <Show when={lab.scene()}>
        {(scene) => (
          <Show when={lab.state()}>
            {(state) => (
              <>
                <About state={state()} policy={scene().parameters.rl_policy} />
                <Show when={!isLedFromOutside(state())}>
                  <SwitchingLaw state={state()} scene={scene()} />
                </Show>
                {props.children}
                {/* Not before the rest, which would push it down. */}
                <ParameterForm lab={lab} scene={scene()} />
              </>
            )}
          </Show>
        )}
      </Show>
      <PlaceNotice lab={lab} place="controller" />
    </section>
  );
}

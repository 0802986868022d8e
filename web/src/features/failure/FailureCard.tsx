// Explains why a goal was not reached, and what to try.

import { Show, createMemo, createSignal, type JSX } from 'solid-js';
import { CommandButton } from '../../lab/CommandButton';
import { attemptStart, START_NOT_KEPT } from '../../lab/attemptStart';
import { CONTROLLER_LABELS } from '../../lab/parameters';
import {
  adviceOf,
  type Attempt,
  betterController,
  causeOf,
  type Failed,
  failedAttempt,
  furtherSteps,
  needsReset,
} from '../../lab/failure';
import type { Events, Panels, Pictures, Session, Trial } from '../../lab/slices';
import { CloseButton } from '../../ui/CloseButton';
import { SmallButton } from '../../ui/SmallButton';
import './failure.css';

type FailureLab = Session & Trial & Events & Pictures & Panels;

/** What can help. */
function Offers(props: { lab: FailureLab; attempt: Attempt }): JSX.Element {
  const { lab } = props;
  /** Sets the same goal again, which begins another attempt. */
  const tryAgain = (): void => {
    const goal = lab.goal();
    if (goal) void lab.send('workspace', { type: 'set_goal', x_m: goal[0], y_m: goal[1] });
    if (!lab.state()?.running) void lab.send('workspace', { type: 'run' });
  };
  return (
    <>
      <Show when={adviceOf(props.attempt)}>{(advice) => <p>{advice()}</p>}</Show>
      <Show when={needsReset(props.attempt)}>
        <div class="buttons">
          <CommandButton lab={lab} at="workspace" class="small" command={() => ({ type: 'reset' })}>
            Reset
          </CommandButton>
        </div>
      </Show>
      <Show when={furtherSteps(props.attempt)}>
        {(steps) => (
          <div class="buttons">
            <Show when={betterController(props.attempt)}>
              {(name) => (
                <CommandButton
                  lab={lab}
                  at="workspace"
                  class="small"
                  onDone={tryAgain}
                  command={() => ({ type: 'select_controller', controller: name() })}
                >
                  Try {CONTROLLER_LABELS[name()]}
                </CommandButton>
              )}
            </Show>
            <SmallButton onClick={tryAgain}>Go on for {steps()} more steps</SmallButton>
            <CommandButton
              lab={lab}
              at="workspace"
              class="small"
              disabled={attemptStart(lab) === undefined}
              title={
                attemptStart(lab) === undefined
                  ? START_NOT_KEPT
                  : 'Continues from the moment at which the goal was set, under each controller'
              }
              command={() => {
                const tick = attemptStart(lab);
                return tick === undefined ? undefined : { type: 'fork', tick };
              }}
              onDone={() => lab.showPanel('compare')}
            >
              Compare from the start
            </CommandButton>
          </div>
        )}
      </Show>
    </>
  );
}

export function FailureCard(props: { lab: FailureLab }): JSX.Element {
  const { lab } = props;
  /** The end that the user has closed the card of. */
  const [closed, setClosed] = createSignal('');
  const attempt = createMemo(
    (before: Failed | undefined): Failed | undefined => {
      const state = lab.state();
      const scene = lab.scene();
      if (!state || !scene) return undefined;
      const judgement = lab.overlay()?.judgement;
      // A policy with a memory needs no training on the map.
      const trainedOn = judgement?.has_memory ? undefined : judgement?.trained_on;
      return failedAttempt(before, state, scene, trainedOn);
    },
    undefined,
    { equals: (a, b) => JSON.stringify(a) === JSON.stringify(b) },
  );
  const open = (): Failed | undefined => {
    const now = attempt();
    return now?.key === closed() ? undefined : now;
  };
  return (
    <Show when={open()}>
      {(now) => (
        <section class="failure" role="status" aria-label="Not delivered">
          <header>
            <h2>Not delivered</h2>
            <CloseButton label="Close" onClose={() => setClosed(now().key)} />
          </header>
          <p>{causeOf(now())}</p>
          <Show when={lab.canOperate()}>
            <Offers lab={lab} attempt={now()} />
          </Show>
        </section>
      )}
    </Show>
  );
}

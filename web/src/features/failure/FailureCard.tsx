// Explains why a goal was not reached, and what to try. Over the lower edge of the workspace, where it moves nothing.

import { Show, createMemo, createSignal, type JSX } from 'solid-js';
import { CONTROLLER_LABELS } from '../../lab/parameters';
import { type Attempt, betterController, causeOf, isFailure, LIFTED_OFF } from '../../lab/failure';
import type { Events, OpenTab, Pictures, Session, Trial } from '../../lab/slices';
import './failure.css';

type FailureLab = Session & Trial & Events & Pictures & OpenTab;

function Card(props: { lab: FailureLab; attempt: Attempt; onClose: () => void }): JSX.Element {
  const { lab } = props;
  const better = () => betterController(props.attempt);
  const isLifted = (): boolean => props.attempt.end === LIFTED_OFF;
  /** Sets the same goal again, which begins another attempt. */
  const tryAgain = (): void => {
    const goal = lab.goal();
    if (goal) lab.send({ type: 'set_goal', x_m: goal[0], y_m: goal[1] });
    if (!lab.state()?.running) lab.send({ type: 'run' });
  };
  /** The moment at which the goal was set, or the oldest one that is kept. */
  const start = (): number => {
    const set = lab.marks().findLast(({ kind }) => kind === 'goal');
    return Math.max(set?.tick ?? 0, lab.state()?.oldest_tick ?? 0);
  };
  return (
    <section class="failure" role="status" aria-label="Not delivered">
      <header>
        <h3>Not delivered</h3>
        <button type="button" class="bare" aria-label="Close" onClick={props.onClose}>
          ×
        </button>
      </header>
      <p>{causeOf(props.attempt)}</p>
      <Show when={lab.canOperate()}>
        <div class="buttons">
          <Show
            when={isLifted()}
            fallback={
              <>
                <Show when={better()}>
                  {(name) => (
                    <button
                      type="button"
                      class="small primary"
                      onClick={() => {
                        lab.send({ type: 'select_controller', controller: name() });
                        tryAgain();
                      }}
                    >
                      Try {CONTROLLER_LABELS[name()]}
                    </button>
                  )}
                </Show>
                <button type="button" class="small" onClick={tryAgain}>
                  Go on for 150 more steps
                </button>
                <button
                  type="button"
                  class="small"
                  title="Continues from the moment at which the goal was set, under each controller"
                  onClick={() => {
                    lab.send({ type: 'fork', tick: start() });
                    lab.openTab('compare');
                  }}
                >
                  Compare from the start
                </button>
              </>
            }
          >
            <button
              type="button"
              class="small primary"
              onClick={() => {
                lab.send({ type: 'reset' });
              }}
            >
              Reset
            </button>
          </Show>
        </div>
      </Show>
    </section>
  );
}

export function FailureCard(props: { lab: FailureLab }): JSX.Element {
  const { lab } = props;
  /** The end that the user has closed the card of. */
  const [closed, setClosed] = createSignal('');
  const attempt = createMemo(
    (): Attempt | undefined => {
      const state = lab.state();
      const scene = lab.scene();
      if (!state || !scene || !isFailure(state.phase)) return undefined;
      return {
        controller: state.controller,
        end: state.phase,
        trouble: state.trouble,
        map: scene.map,
        trainedOn: lab.overlay()?.judgement?.trained_on,
      };
    },
    undefined,
    { equals: (a, b) => JSON.stringify(a) === JSON.stringify(b) },
  );
  /** The trial, the goal and the steps tell one end from the next. */
  const key = (): string =>
    [lab.scene()?.trial, lab.goal()?.join(), lab.state()?.steps, attempt()?.end].join(' ');
  return (
    <Show when={closed() !== key() && attempt()}>
      {(now) => (
        <Card
          lab={lab}
          attempt={now()}
          onClose={() => {
            setClosed(key());
          }}
        />
      )}
    </Show>
  );
}

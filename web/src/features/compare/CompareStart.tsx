// Chooses controllers and starts a comparison.

import { Show, createSignal, type JSX } from 'solid-js';
import { CommandButton } from '../../lab/CommandButton';
import { attemptStart, START_NOT_KEPT } from '../../lab/attemptStart';
import { COMPARABLE, ControllerChecks, createOffered } from '../../lab/ControllerChecks';
import { isFailure } from '../../lab/failure';
import type { Compared, Events, Session, Trial } from '../../lab/slices';
import type { ControllerName } from '../../net/protocol.gen';
import { clock } from '../../ui/format';

export function CompareStart(props: { lab: Session & Trial & Events & Compared }): JSX.Element {
  const { lab } = props;
  const [chosen, setChosen] = createSignal<ReadonlySet<ControllerName>>(new Set(COMPARABLE));
  const toggle = (name: ControllerName, on: boolean): void => {
    const next = new Set(chosen());
    if (on) next.add(name);
    else next.delete(name);
    setChosen(next);
  };
  const { offered, label } = createOffered(lab);
  const wanted = (): ControllerName[] => offered().filter((name) => chosen().has(name));
  /** At the end of an attempt there is nothing left to compare. */
  const isOver = (): boolean => {
    const phase = lab.state()?.phase;
    return phase !== undefined && (phase.code === 'delivered' || isFailure(phase));
  };
  /** Where the branches begin. */
  const from = (): number | undefined => (isOver() ? attemptStart(lab) : lab.state()?.tick);
  const title = (): string => {
    if (from() === undefined) return START_NOT_KEPT;
    const moment = isOver() ? 'the moment at which the goal was set' : 'this moment';
    return `Continues from ${moment} under each controller, without changing the session`;
  };
  return (
    <div class="compare-start">
      <ControllerChecks
        verb="Compare"
        offered={offered()}
        label={label}
        isChosen={(name) => chosen().has(name)}
        onToggle={toggle}
      />
      <CommandButton
        lab={lab}
        at="compare"
        class="small primary"
        disabled={wanted().length === 0 || from() === undefined}
        title={title()}
        command={() => {
          const tick = from();
          return tick === undefined ? undefined : { type: 'fork', tick, controllers: wanted() };
        }}
      >
        Start comparison
      </CommandButton>
      <span class="compare-of" role="status">
        <Show when={lab.comparison.shown()}>
          {(comparison) => (
            <>
              from {clock(comparison().sim_time_s)}
              <Show when={comparison().running}>, running …</Show>
              <Show when={comparison().failed}>{(reason) => <>: failed: {reason()}</>}</Show>
            </>
          )}
        </Show>
      </span>
    </div>
  );
}

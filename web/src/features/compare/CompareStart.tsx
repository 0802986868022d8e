// Chooses controllers and starts a comparison.

import { GitCompare } from 'lucide';
import { Show, createSignal, type JSX } from 'solid-js';
import { attemptStart, START_NOT_KEPT } from '../../lab/attemptStart';
import { isFailure } from '../../lab/failure';
import { createTakingPart } from '../../lab/offered';
import type { Compared, Events, Session, Trial } from '../../lab/slices';
import type { ControllerName } from '../../net/protocol.gen';
import { CheckField } from '../../ui/fields/fields';
import { Form } from '../../ui/fields/Form';
import { clock } from '../../ui/format';

export function CompareStart(props: { lab: Session & Trial & Events & Compared }): JSX.Element {
  const { lab } = props;
  const [leftOut, setLeftOut] = createSignal<readonly ControllerName[]>([]);
  const { wanted, field } = createTakingPart(lab, leftOut, setLeftOut);
  /** At the end of an attempt there is nothing left to compare. */
  const isOver = (): boolean => {
    const phase = lab.state()?.phase;
    return phase !== undefined && (phase.code === 'delivered' || isFailure(phase));
  };
  /** Where the branches begin. */
  const from = (): number | undefined => (isOver() ? attemptStart(lab) : lab.state()?.tick);
  const from_s = (): number => (from() ?? 0) * (lab.scene()?.tick_s ?? 0);
  const title = (): string => {
    if (from() === undefined) return START_NOT_KEPT;
    const moment = isOver() ? 'the moment at which the goal was set' : 'this moment';
    return `Continues from ${moment} under each controller, without changing the session`;
  };
  const hasResults = (): boolean => lab.comparison.shown() !== undefined;
  return (
    <Form
      class={`compare-start ${hasResults() ? '' : 'first'}`}
      send={async () => {
        const tick = from();
        if (tick === undefined) return;
        await lab.send('compare', { type: 'fork', tick, controllers: wanted() });
      }}
      button={`Compare from ${isOver() ? 'the last goal, ' : ''}${clock(from_s())}`}
      {...(hasResults() && { icon: GitCompare })}
      buttonTitle={title()}
      disabled={!lab.canOperate() || from() === undefined}
      why={from() === undefined ? START_NOT_KEPT : undefined}
      isFoot={hasResults()}
      beside={
        <Show when={hasResults()}>
          <button
            type="button"
            class="ghost"
            aria-label="Clear ghosts"
            title="Takes the ghosts off the map"
            onClick={() => {
              lab.comparison.hide();
            }}
          >
            Clear
          </button>
        </Show>
      }
    >
      <CheckField {...field} verb="Compare" />
    </Form>
  );
}

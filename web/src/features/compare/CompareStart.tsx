// Chooses controllers and starts a comparison.

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
  const title = (): string => {
    if (from() === undefined) return START_NOT_KEPT;
    const moment = isOver() ? 'the moment at which the goal was set' : 'this moment';
    return `Continues from ${moment} under each controller, without changing the session`;
  };
  return (
    <Form
      class="compare-start"
      isInline
      send={async () => {
        const tick = from();
        if (tick === undefined) return;
        await lab.send('compare', { type: 'fork', tick, controllers: wanted() });
      }}
      button="Start comparison"
      buttonClass="small primary"
      buttonTitle={title()}
      disabled={!lab.canOperate() || from() === undefined}
      why={from() === undefined ? START_NOT_KEPT : undefined}
      beside={
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
      }
    >
      <CheckField {...field} verb="Compare" />
    </Form>
  );
}

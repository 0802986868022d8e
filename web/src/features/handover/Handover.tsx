// Another browser asks for control: the operator gives it or keeps it, and hears how a request ended.

import { Show, createEffect, createMemo, on, type JSX } from 'solid-js';
import type { Notices, Session } from '../../lab/slices';
import { createCountdown, own } from './countdown';

/** Control passed on because its time was over, if this was left at the last count. */
const OVER_S = 1;

export function Handover(props: { lab: Session & Notices }): JSX.Element {
  const { lab } = props;
  const left_s = createCountdown(lab);
  const isAsked = createMemo(() => lab.hello()?.asked === true);
  let last_s = 0;
  createEffect(() => (last_s = left_s() ?? last_s));
  createEffect(
    on(lab.hello, (now, before) => {
      if (now?.role !== 'viewer') return;
      if (before?.asked && last_s <= OVER_S)
        lab.notify('session', 'Another browser has control now: nothing was done here for 30 s.');
      else if (before?.asks && !now.asks && now.operator_present && !own.isWithdrawn)
        lab.notify('session', 'The operator keeps control. You can ask again in a minute.');
      if (!now.asks) own.isWithdrawn = false;
    }),
  );
  return (
    <div class="notices" role="alert">
      <Show when={isAsked()}>
        <p class="notice">
          <span>
            Another browser asks for control. If you do nothing, it gets it in{' '}
            <span class="number" aria-live="off">
              {left_s()} s
            </span>
            .
          </span>
          <button
            type="button"
            class="small primary"
            onClick={() => void lab.send('session', { type: 'keep_control' })}
          >
            Keep
          </button>
          <button
            type="button"
            class="small"
            onClick={() => void lab.send('session', { type: 'release_control' })}
          >
            Give control
          </button>
        </p>
      </Show>
    </div>
  );
}

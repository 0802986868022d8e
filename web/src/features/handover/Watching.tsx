// In place of the transport: why a viewer cannot act, and what can be done.

import { Eye } from 'lucide';
import { Show, type JSX } from 'solid-js';
import { OwnSessionButton } from '../../lab/OwnSessionButton';
import type { Session } from '../../lab/slices';
import { counted } from '../../ui/format';
import { Icon } from '../../ui/Icon';
import { createCountdown, own } from './countdown';
import './handover.css';

export function Watching(props: { lab: Session; children: JSX.Element }): JSX.Element {
  const { lab } = props;
  const left_s = createCountdown(lab);
  const isFree = (): boolean => lab.hello()?.operator_present === false;
  const ahead = (): number => lab.hello()?.ahead ?? 0;
  return (
    <div class="transport watching" data-asks={lab.hello()?.asks}>
      <p>
        <Icon of={Eye} />
        <Show
          when={lab.hello()?.asks}
          fallback={
            <>
              <strong>{isFree() ? 'Control is free.' : 'You are watching.'}</strong>
              <span>
                {isFree() ? 'No browser steers.' : 'Another browser steers. Look around freely.'}
              </span>
            </>
          }
        >
          <strong>You asked for control.</strong>
          <span class="number">
            {ahead() > 0
              ? `${counted(ahead(), 'request')} before yours.`
              : `It is yours in ${left_s()} s if the operator does nothing.`}
          </span>
        </Show>
      </p>
      <div class="dock-tools">{props.children}</div>
      <OwnSessionButton class={isFree() ? '' : 'primary'}>Open your own</OwnSessionButton>
      <Show
        when={lab.hello()?.asks}
        fallback={
          <button
            type="button"
            class={isFree() ? 'primary' : undefined}
            onClick={() => void lab.send('session', { type: 'take_control' })}
          >
            Take control
          </button>
        }
      >
        <button
          type="button"
          onClick={() => {
            own.isWithdrawn = true;
            void lab.send('session', { type: 'release_control' });
          }}
        >
          Withdraw
        </button>
      </Show>
    </div>
  );
}

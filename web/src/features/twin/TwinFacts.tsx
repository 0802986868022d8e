// The robot that the arm mirrors, and the button that lets it follow Ferry's controller while it is held.

import { Show, createEffect, onCleanup, type JSX } from 'solid-js';
import type { Session, Trial } from '../../lab/slices';
import type { TwinStanding } from '../../net/protocol.gen';
import { listen } from '../../ui/listen';
import { createHold } from './hold';
import { connectionWords, doubtWords, robotMotionWords } from '../../words/robot';
import './twin.css';

const isKey = ({ key }: KeyboardEvent): boolean => key === ' ' || key === 'Enter';

function HoldButton(props: { lab: Session; twin: TwinStanding }): JSX.Element {
  const { lab } = props;
  const hold = createHold((press) =>
    lab.stream({ type: 'drive_robot', ...(press === undefined ? {} : { press }) }),
  );
  const isEnabled = (): boolean => lab.canOperate() && props.twin.trouble === null;
  createEffect(() => {
    if (!isEnabled()) hold.release();
  });
  // A page that cannot be seen holds nothing.
  listen('visibilitychange', hold.release);
  listen('blur', hold.release);
  onCleanup(hold.release);
  return (
    <button
      type="button"
      class="hold"
      classList={{ driven: props.twin.is_driven }}
      disabled={!isEnabled()}
      aria-describedby="twin-motion"
      onPointerDown={(event) => {
        if (event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        hold.press();
      }}
      onPointerUp={hold.release}
      onPointerCancel={hold.release}
      onLostPointerCapture={hold.release}
      // A long touch would open a menu.
      onContextMenu={(event) => event.preventDefault()}
      onKeyDown={(event) => {
        if (!isKey(event)) return;
        event.preventDefault();
        hold.press();
      }}
      onKeyUp={(event) => {
        if (isKey(event)) hold.release();
      }}
      onBlur={hold.release}
    >
      Hold to move the robot
    </button>
  );
}

/** Shown if the arm of this session mirrors a robot. */
export function TwinFacts(props: { lab: Session & Trial }): JSX.Element {
  return (
    <Show when={props.lab.state()?.twin}>
      {(twin) => (
        <section class="twin-facts stack" aria-label="Robot">
          <p data-testid="twin-connection" classList={{ stopped: twin().trouble !== null }}>
            {connectionWords(twin())}
          </p>
          <Show when={twin().doubt}>
            {(doubt) => (
              <p data-testid="twin-doubt" class="doubt">
                {doubtWords(doubt())}
              </p>
            )}
          </Show>
          <p
            id="twin-motion"
            data-testid="twin-motion"
            classList={{ stopped: twin().stopped !== null }}
            role={twin().trouble === null && twin().stopped === null ? undefined : 'alert'}
          >
            {robotMotionWords(twin())}
          </p>
          <Show when={twin().allows_motion}>
            <HoldButton lab={props.lab} twin={twin()} />
            <p class="hint">Not safety-rated: the robot’s emergency stop must be within reach.</p>
          </Show>
        </section>
      )}
    </Show>
  );
}

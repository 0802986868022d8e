// What pointer and keys do on the map: in few words for the eyes, whole for screen readers.

import { Show, type JSX } from 'solid-js';
import { HandGrab, Keyboard, Move3d, Target, type IconNode } from 'lucide';
import type { Press } from '../plan/layer';
import { Icon } from '../ui/Icon';
import { IS_TOUCH } from '../ui/touch';

function Hint(props: { icon: IconNode; children: JSX.Element }): JSX.Element {
  return (
    <span class="hint-words">
      <Icon of={props.icon} />
      <span>{props.children}</span>
    </span>
  );
}

const DragHint = (): JSX.Element => <Hint icon={HandGrab}>Drag the bead to disturb it</Hint>;

export function WorkspaceHint(props: {
  steers: boolean;
  scene: boolean;
  press: Press | undefined;
}): JSX.Element {
  return (
    <Show
      when={!props.steers}
      fallback={
        <>
          <Hint icon={HandGrab}>Press and move: the magnet follows</Hint>{' '}
          <Show when={!IS_TOUCH}>
            <Hint icon={Keyboard}>Or hold the arrow keys</Hint>
          </Show>
        </>
      }
    >
      {/* The last one may have no room. */}
      <Show when={props.press} fallback={<DragHint />}>
        {(press) => (
          <Hint icon={Target}>
            {press().shown}: {IS_TOUCH ? 'tap' : 'click'} {press().words}
          </Hint>
        )}
      </Show>{' '}
      <Show when={!props.press} fallback={<DragHint />}>
        <Hint icon={Target}>{IS_TOUCH ? 'Tap' : 'Click'} to set the goal</Hint>
      </Show>{' '}
      <Show when={props.scene}>
        <Hint icon={Move3d}>Drag elsewhere to turn the view</Hint>
      </Show>
      <span class="visually-hidden">
        {' '}
        Shift lifts the bead over walls. Keys: arrows, Enter, D.
        <Show when={props.scene}>
          {' '}
          Brackets turn the view, Page Up and Page Down tilt it, plus and minus zoom, Home resets
          it. The right mouse button moves it.
        </Show>
      </span>
    </Show>
  );
}

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
      <Hint icon={HandGrab}>Drag the bead to disturb it</Hint>{' '}
      <Hint icon={Target}>
        {IS_TOUCH ? 'Tap' : 'Click'} {props.press?.words ?? 'to set the goal'}
      </Hint>{' '}
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

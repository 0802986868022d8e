// What pointer and keys do on the workspace.

import { Show, type JSX } from 'solid-js';
import { IS_TOUCH } from '../ui/touch';

const STEER = IS_TOUCH
  ? 'Press and move the finger: the tool follows.'
  : 'Press and move the pointer, or hold the arrow keys: the tool follows.';
const SET_GOAL = IS_TOUCH
  ? 'Tap to set a goal. Drag the bead to disturb it.'
  : 'Click to set a goal. Drag the bead to disturb it (Shift: lift over walls).';
const TURN = IS_TOUCH
  ? 'Drag elsewhere to turn the view, pinch to zoom.'
  : 'Drag elsewhere to turn the view, use the wheel to zoom.';

export function WorkspaceHint(props: { steers: boolean; scene: boolean }): JSX.Element {
  return (
    <>
      {props.steers ? STEER : SET_GOAL}
      <Show when={props.scene && !props.steers}> {TURN}</Show>
      <Show when={!IS_TOUCH && !props.steers}> Keys: arrows, Enter, D.</Show>
      <Show when={props.scene}>
        <span class="visually-hidden">
          {' '}
          Brackets turn the view, Page Up and Page Down tilt it, plus and minus zoom, Home resets
          it. The right mouse button moves it.
        </span>
      </Show>
    </>
  );
}

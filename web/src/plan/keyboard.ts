// The workspace by keyboard: arrows move a cursor, Enter sets the goal, D grabs and releases the bead, Escape releases it
// or cancels picking.

import type { Shortcut } from '../ui/shortcuts';
import type { Hand } from './hand';
import { clampToRect, distance, type Vec2 } from '../lab/geometry';
import type { Trial } from '../lab/slices';

/** Shown in the help. The canvas handles these keys itself. */
export const WORKSPACE_SHORTCUTS: readonly Shortcut[] = [
  {
    group: 'Workspace',
    keys: ['ArrowLeft', 'ArrowUp', 'ArrowRight', 'ArrowDown'],
    does: 'move the cursor, or the grabbed bead (Shift: over walls)',
  },
  { group: 'Workspace', keys: ['Enter'], does: 'set the goal, or pick the place, at the cursor' },
  { group: 'Workspace', keys: ['d'], does: 'grab or release the bead' },
  { group: 'Workspace', keys: ['Escape'], does: 'release the bead, cancel picking' },
];

const STEP_M = 0.005;
export const ARROWS: Partial<Record<string, Vec2>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};
/** Nearer than this to the bead, the cursor stays in place when the hand grabs the bead. */
const REACH_M = 0.02;

export interface Cursor {
  readonly at: () => Vec2 | undefined;
  readonly put: (at: Vec2) => void;
  /** Direction on the table of an arrow on the screen. */
  readonly turned: (arrow: Vec2) => Vec2;
}

/** Listens while the canvas exists. */
export function attachKeyboard(
  canvas: HTMLCanvasElement,
  lab: Trial,
  hand: Hand,
  cursor: Cursor,
  place: (at: Vec2) => void,
  escape: () => void,
): void {
  const bead = (): Vec2 | undefined => {
    const state = lab.state();
    return state && [state.bead_m[0], state.bead_m[1]];
  };
  const holds = (): boolean => {
    const drag = hand.drag();
    return drag.kind === 'held' && drag.by === 'keyboard';
  };

  const move = (direction: Vec2, lift: boolean): void => {
    const scene = lab.scene();
    const from = cursor.at() ?? bead();
    if (!scene || !from) return;
    const to = clampToRect(scene.workspace, [
      from[0] + direction[0] * STEP_M,
      from[1] + direction[1] * STEP_M,
    ]);
    cursor.put(to);
    if (holds()) hand.dispatch({ type: 'move', by: 'keyboard', at: to, isBeyondSlop: true, lift });
  };

  const takeOrRelease = (): void => {
    if (holds()) {
      hand.dispatch({ type: 'put' });
      return;
    }
    const beadAt = bead();
    if (!beadAt || !hand.mayAct()) return;
    // A distant cursor jumps to the bead first, so that grabbing does not fling the bead across the map.
    const here = cursor.at();
    const from = here && distance(here, beadAt) <= REACH_M ? here : beadAt;
    cursor.put(from);
    hand.dispatch({ type: 'take', at: from });
  };

  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const direction = ARROWS[event.key];
    if (direction) {
      move(cursor.turned(direction), event.shiftKey);
    } else if (event.key === 'Enter') {
      const at = cursor.at();
      // A held key does not set a second goal.
      if (!at || event.repeat) return;
      place(at);
    } else if (event.key === 'd' || event.key === 'D') {
      // A held key grabs only once.
      if (!event.repeat) takeOrRelease();
    } else if (event.key === 'Escape') {
      hand.release('escape');
      escape();
    } else {
      return;
    }
    event.preventDefault();
  });
}

// What a press on the workspace means: a click places the goal, a drag that starts on the bead is
// the disturbance. Pure: events in, new state and effects out; the canvas does the rest.

import { distance, type Vec2 } from '../lab/geometry';

/** Who holds the bead: a pointer by its id, or the keyboard. */
export type Holder = number | 'keyboard';

export type DragState =
  | { readonly kind: 'idle' }
  | {
      readonly kind: 'pressed';
      readonly pointer: number;
      readonly from: Vec2;
      readonly onBead: boolean;
      readonly slopPx: number;
    }
  | { readonly kind: 'held'; readonly by: Holder; readonly at: Vec2; readonly lift: boolean };

export type DragEvent =
  | {
      readonly type: 'down';
      readonly pointer: number;
      readonly at: Vec2;
      readonly onBead: boolean;
      /** Movement below this is a shaky click. */
      readonly slopPx: number;
    }
  | { readonly type: 'move'; readonly by: Holder; readonly at: Vec2; readonly lift: boolean }
  | { readonly type: 'lift'; readonly lift: boolean }
  | { readonly type: 'up'; readonly pointer: number }
  | { readonly type: 'take'; readonly at: Vec2 }
  | { readonly type: 'cancel' };

export type DragEffect =
  | { readonly type: 'goal'; readonly at: Vec2 }
  | { readonly type: 'drag'; readonly at: Vec2; readonly lift: boolean }
  | { readonly type: 'release' };

export const IDLE: DragState = { kind: 'idle' };

const nothing = (state: DragState): [DragState, DragEffect[]] => [state, []];

function hold(by: Holder, at: Vec2, lift: boolean): [DragState, DragEffect[]] {
  return [{ kind: 'held', by, at, lift }, [{ type: 'drag', at, lift }]];
}

export function dragStep(state: DragState, event: DragEvent): [DragState, DragEffect[]] {
  switch (event.type) {
    case 'down':
      // A second finger changes nothing for the first.
      if (state.kind !== 'idle') return nothing(state);
      return nothing({
        kind: 'pressed',
        pointer: event.pointer,
        from: event.at,
        onBead: event.onBead,
        slopPx: event.slopPx,
      });
    case 'take':
      return state.kind === 'idle' ? hold('keyboard', event.at, false) : nothing(state);
    case 'move':
      if (state.kind === 'held' && state.by === event.by) {
        return hold(event.by, event.at, event.lift);
      }
      if (
        state.kind === 'pressed' &&
        state.pointer === event.by &&
        distance(state.from, event.at) > state.slopPx
      ) {
        // A long press-and-move off the bead was neither a click nor a drag: forget it.
        return state.onBead ? hold(event.by, event.at, event.lift) : nothing(IDLE);
      }
      return nothing(state);
    case 'lift':
      return state.kind === 'held' && state.lift !== event.lift
        ? hold(state.by, state.at, event.lift)
        : nothing(state);
    case 'up':
      if (state.kind === 'pressed' && state.pointer === event.pointer) {
        return [IDLE, [{ type: 'goal', at: state.from }]];
      }
      if (state.kind === 'held' && state.by === event.pointer) {
        return [IDLE, [{ type: 'release' }]];
      }
      return nothing(state);
    case 'cancel':
      return [IDLE, state.kind === 'held' ? [{ type: 'release' }] : []];
  }
}

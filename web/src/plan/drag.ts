// The drag machine: a click on the workspace sets the goal, a drag that starts on the bead disturbs it. Pure; places are
// in metres.

import type { Vec2 } from '../lab/geometry';

/** Who holds the bead: a pointer by its id, or the keyboard. */
export type Holder = number | 'keyboard';

export type DragState =
  | { readonly kind: 'idle' }
  | {
      readonly kind: 'pressed';
      readonly pointer: number;
      readonly from: Vec2;
      readonly onBead: boolean;
    }
  | { readonly kind: 'held'; readonly by: Holder; readonly at: Vec2; readonly lift: boolean };

export type DragEvent =
  | {
      readonly type: 'down';
      readonly pointer: number;
      readonly at: Vec2;
      readonly onBead: boolean;
    }
  | {
      readonly type: 'move';
      readonly by: Holder;
      /** Not set while the pointer is beside the table's picture. */
      readonly at: Vec2 | undefined;
      /** Whether the pointer has moved too far for a click. */
      readonly isBeyondSlop: boolean;
      readonly lift: boolean;
    }
  | { readonly type: 'lift'; readonly lift: boolean }
  | { readonly type: 'up'; readonly pointer: number }
  | { readonly type: 'take'; readonly at: Vec2 }
  /** The keyboard puts down what it has taken. */
  | { readonly type: 'put' }
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
      // A second finger does not change the first drag.
      if (state.kind !== 'idle') return nothing(state);
      return nothing({
        kind: 'pressed',
        pointer: event.pointer,
        from: event.at,
        onBead: event.onBead,
      });
    case 'take':
      return state.kind === 'idle' ? hold('keyboard', event.at, false) : nothing(state);
    case 'move':
      if (state.kind === 'held' && state.by === event.by) {
        return event.at ? hold(event.by, event.at, event.lift) : nothing(state);
      }
      if (state.kind === 'pressed' && state.pointer === event.by && event.isBeyondSlop) {
        // A press that moved beside the bead is neither a click nor a drag: ignore it.
        if (!state.onBead) return nothing(IDLE);
        if (event.at) return hold(event.by, event.at, event.lift);
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
    case 'put':
      return state.kind === 'held' && state.by === 'keyboard'
        ? [IDLE, [{ type: 'release' }]]
        : nothing(state);
    case 'cancel':
      return [IDLE, state.kind === 'held' ? [{ type: 'release' }] : []];
  }
}

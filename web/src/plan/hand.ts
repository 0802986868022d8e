// The hand on the workspace: runs the drag machine and sends its effects as messages.

import { createSignal, type Accessor } from 'solid-js';
import { type DragEvent, type DragState, dragStep, IDLE } from './drag';
import { Limiter } from '../net/limiter';
import { Repeater } from '../net/repeater';
import { clampToRect, type Vec2 } from '../lab/geometry';
import { ends, type Release } from './release';
import type { Notices, Session, Trial } from '../lab/slices';

const MAX_DRAGS_PER_S = 60;
/** A hand that does not move repeats its message: after five seconds without one the server releases the bead. */
const STILL_THERE_MS = 500;

export interface Hand {
  readonly drag: Accessor<DragState>;
  dispatch(event: Exclude<DragEvent, { type: 'cancel' }>): void;
  /** Ends the drag if the cause applies to it. */
  readonly release: Release;
  /** Whether this browser may act; shows a notice if not. */
  mayAct(): boolean;
}

/** `place` is called for clicks. */
export function createHand(lab: Session & Trial & Notices, place: (at: Vec2) => void): Hand {
  const [drag, setDrag] = createSignal<DragState>(IDLE);
  const holds = new Repeater<{ at: Vec2; lift: boolean }>(STILL_THERE_MS, ({ at, lift }) => {
    lab.stream({ type: 'drag', x_m: at[0], y_m: at[1], lift });
  });
  const drags = new Limiter<{ at: Vec2; lift: boolean }>(1000 / MAX_DRAGS_PER_S, (wish) => {
    holds.say(wish);
  });

  const mayAct = (): boolean => {
    if (lab.canOperate()) return true;
    if (lab.connection().kind === 'live') {
      lab.notify('workspace', 'You are watching. Take control to set goals or move the bead.');
    }
    return false;
  };

  const step = (event: DragEvent): void => {
    const [next, effects] = dragStep(drag(), event);
    setDrag(next);
    for (const effect of effects) {
      if (effect.type === 'release') {
        drags.flush();
        holds.stop();
        lab.stream({ type: 'release' });
      } else if (effect.type === 'goal') {
        place(effect.at);
      } else {
        const scene = lab.scene();
        if (scene) drags.offer({ at: clampToRect(scene.workspace, effect.at), lift: effect.lift });
      }
    }
  };
  const release: Release = (cause, pointer) => {
    if (ends(cause, drag(), pointer)) step({ type: 'cancel' });
  };
  return { drag, mayAct, dispatch: step, release };
}

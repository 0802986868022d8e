// The hand on the workspace: runs the drag machine and turns its effects into messages.

import { createSignal, type Accessor } from 'solid-js';
import { type DragEvent, type DragState, dragStep, IDLE } from './drag';
import { Limiter } from '../net/limiter';
import { Repeater } from '../net/repeater';
import { clampToRect, type TableView, type Vec2 } from '../lab/geometry';
import type { Notices, Session, Trial } from '../lab/slices';

const MAX_DRAGS_PER_S = 60;
/** A hand that holds still says so; of one that is silent for five seconds the server takes the bead. */
const STILL_THERE_MS = 500;

export interface Hand {
  readonly drag: Accessor<DragState>;
  dispatch(event: DragEvent): void;
  /** Whether this browser may act; tells the person when it may not. */
  mayAct(): boolean;
}

/** `place` hears of clicks, in metres. */
export function createHand(
  lab: Session & Trial & Notices,
  view: () => TableView | undefined,
  place: (at: Vec2) => void,
): Hand {
  const [drag, setDrag] = createSignal<DragState>(IDLE);
  const holds = new Repeater<{ at: Vec2; lift: boolean }>(STILL_THERE_MS, ({ at, lift }) => {
    lab.send({ type: 'drag', x_m: at[0], y_m: at[1], lift });
  });
  const drags = new Limiter<{ at: Vec2; lift: boolean }>(1000 / MAX_DRAGS_PER_S, (wish) => {
    holds.say(wish);
  });

  const mayAct = (): boolean => {
    if (lab.canOperate()) return true;
    if (lab.connection().kind === 'live') {
      lab.notify('workspace', 'You are watching. Take control to place goals or move the bead.');
    }
    return false;
  };

  const dispatch = (event: DragEvent): void => {
    const [next, effects] = dragStep(drag(), event);
    setDrag(next);
    for (const effect of effects) {
      if (effect.type === 'release') {
        drags.flush();
        holds.stop();
        lab.send({ type: 'release' });
        continue;
      }
      const at = view()?.toWorld(effect.at);
      const scene = lab.scene();
      if (!at || !scene) continue;
      if (effect.type === 'goal') {
        place(at);
      } else {
        drags.offer({ at: clampToRect(scene.workspace, at), lift: effect.lift });
      }
    }
  };
  return { drag, mayAct, dispatch };
}

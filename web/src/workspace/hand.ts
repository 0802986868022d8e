// The hand on the workspace: runs the drag machine and turns its effects into messages.

import { createSignal, type Accessor } from 'solid-js';
import { IDLE, dragStep, type DragEvent, type DragState } from '../drag';
import type { Lab } from '../lab';
import { Limiter } from '../limiter';
import { clampToRect, type TableView, type Vec2 } from '../transform';

const MAX_DRAGS_PER_S = 60;

export interface Hand {
  readonly drag: Accessor<DragState>;
  dispatch(event: DragEvent): void;
  /** Whether this browser may act; tells the person when it may not. */
  mayAct(): boolean;
}

/** `place` hears of clicks, in metres. */
export function createHand(
  lab: Lab,
  view: () => TableView | undefined,
  place: (at: Vec2) => void,
): Hand {
  const [drag, setDrag] = createSignal<DragState>(IDLE);
  const drags = new Limiter<{ at: Vec2; lift: boolean }>(1000 / MAX_DRAGS_PER_S, (wish) => {
    lab.send({ type: 'drag', x_m: wish.at[0], y_m: wish.at[1], lift: wish.lift });
  });

  const mayAct = (): boolean => {
    if (lab.canOperate()) return true;
    if (lab.link().kind === 'live') {
      lab.notify('workspace', 'You are watching. Take control to place goals or move the bead.');
    }
    return false;
  };

  return {
    drag,
    mayAct,
    dispatch(event) {
      const [next, effects] = dragStep(drag(), event);
      setDrag(next);
      for (const effect of effects) {
        if (effect.type === 'release') {
          drags.flush();
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
    },
  };
}

// The interaction with the workspace in both views: the hand, the pointer, the keyboard's cursor.

import { createMemo, createSignal, type Accessor, type Setter } from 'solid-js';
import { createHand, type Hand } from './hand';
import { createPicker, type Picker } from './picker';
import { type Pointing, reachesBead } from './pointer';
import { releaseWithLab } from './release';
import type { TableView, Vec2 } from '../lab/geometry';
import type { Notices, Session, Trial } from '../lab/slices';

export interface Interaction {
  /** The mapping of the open view; undefined until its size is known. */
  readonly view: Accessor<TableView | undefined>;
  readonly setView: Setter<TableView | undefined>;
  readonly hand: Hand;
  readonly picker: Picker;
  readonly setPointing: Setter<Pointing | undefined>;
  /** Distance from the bead within which a press takes it; undefined for that of the pointer's kind. */
  readonly grabPx: number | undefined;
  /** Radius of the ring around the bead if a press at the pointer would grab it. */
  readonly reachPx: Accessor<number | undefined>;
  readonly cursor: Accessor<Vec2 | undefined>;
  readonly setCursor: Setter<Vec2 | undefined>;
  readonly focused: Accessor<boolean>;
  readonly setFocused: Setter<boolean>;
  /** The point of the table under the pointer, otherwise under the keyboard's cursor. */
  readonly at: Accessor<Vec2 | undefined>;
  /** Gives the place to the picker if it waits for one, otherwise sets the goal. */
  readonly place: (at: Vec2) => void;
  readonly setGoal: (at: Vec2) => void;
  /** Called when a view closes. */
  leave(): void;
}

export function createInteraction(lab: Session & Trial & Notices, grabPx?: number): Interaction {
  const [view, setView] = createSignal<TableView>();
  const [pointing, setPointing] = createSignal<Pointing>();
  const [cursor, setCursor] = createSignal<Vec2>();
  const [focused, setFocused] = createSignal(false);
  const picker = createPicker();
  const isOnTable = ([x_m, y_m]: Vec2): boolean => {
    const workspace = lab.scene()?.workspace;
    if (!workspace) return false;
    const { x_min_m, x_max_m, y_min_m, y_max_m } = workspace;
    return x_m >= x_min_m && x_m <= x_max_m && y_m >= y_min_m && y_m <= y_max_m;
  };
  const setGoal = (at: Vec2): void => {
    // Beside the table, a click means nothing.
    if (isOnTable(at) && hand.mayAct())
      void lab.send('workspace', { type: 'set_goal', x_m: at[0], y_m: at[1] });
  };
  const place = (at: Vec2): void => {
    if (!picker.offer(at)) setGoal(at);
  };
  const hand = createHand(lab, place);
  const reachPx = createMemo(() => {
    const here = pointing();
    const canTake = lab.canOperate() && hand.drag().kind !== 'held';
    return here && canTake && reachesBead(view(), lab.state()?.bead_m, here)
      ? here.reachPx
      : undefined;
  });

  releaseWithLab(lab, hand.release);

  return {
    view,
    setView,
    hand,
    picker,
    setPointing,
    grabPx,
    reachPx,
    place,
    setGoal,
    cursor,
    setCursor,
    focused,
    setFocused,
    at: () => {
      const px = pointing()?.px;
      if (px) return view()?.toWorld(px);
      return focused() ? cursor() : undefined;
    },
    leave: () => {
      hand.release('view closed');
      picker.cancel();
      setPointing(undefined);
      setFocused(false);
      setView(undefined);
    },
  };
}

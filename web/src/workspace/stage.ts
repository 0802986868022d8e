// What is done on the workspace, whichever view shows it: the hand, the pointer, the keyboard's cursor.

import { createEffect, createSignal, type Accessor, type Setter } from 'solid-js';
import type { Lab } from '../lab';
import type { TableView, Vec2 } from '../transform';
import { createHand, type Hand } from './hand';
import { NOWHERE, type Pointing } from './pointer';

export interface Stage {
  /** Of the view that is open; none before it knows its size. */
  readonly view: Accessor<TableView | undefined>;
  readonly setView: Setter<TableView | undefined>;
  readonly hand: Hand;
  readonly pointing: Accessor<Pointing>;
  readonly setPointing: Setter<Pointing>;
  readonly cursor: Accessor<Vec2 | undefined>;
  readonly setCursor: Setter<Vec2 | undefined>;
  readonly focused: Accessor<boolean>;
  readonly setFocused: Setter<boolean>;
  /** The point of the table that a person points at, by pointer or else by keyboard. */
  readonly at: Accessor<Vec2 | undefined>;
  /** A view goes: what was being done in it ends. */
  leave(): void;
}

export function createStage(lab: Lab): Stage {
  const [view, setView] = createSignal<TableView>();
  const [pointing, setPointing] = createSignal(NOWHERE);
  const [cursor, setCursor] = createSignal<Vec2>();
  const [focused, setFocused] = createSignal(false);
  const hand = createHand(lab, view);

  createEffect(() => {
    // A lost socket has let go of the bead on the server; a lost role may not hold it.
    if (!lab.canOperate()) hand.dispatch({ type: 'cancel' });
  });

  return {
    view,
    setView,
    hand,
    pointing,
    setPointing,
    cursor,
    setCursor,
    focused,
    setFocused,
    at: () => {
      const px = pointing().at;
      if (px) return view()?.toWorld(px);
      return focused() ? cursor() : undefined;
    },
    leave: () => {
      hand.dispatch({ type: 'cancel' });
      setPointing(NOWHERE);
      setFocused(false);
      setView(undefined);
    },
  };
}

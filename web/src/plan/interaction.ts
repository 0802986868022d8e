// The interaction with the workspace in all views: runs the gestures, and sends what they do as messages.

import { createEffect, createMemo, createSignal, on, untrack } from 'solid-js';
import type { Accessor, Setter } from 'solid-js';
import { clampToRect, distance, type TableView, type Vec2 } from '../lab/geometry';
import type { ByHand, Notices, Session, Trial } from '../lab/slices';
import { Limiter } from '../net/limiter';
import { Repeater } from '../net/repeater';
import { refusalWords } from '../words/refusals';
import { type Act, type Effect, type GestureEvent, type Mode, REST, step } from './gesture';
import { type LiveLayer, type Press, shownPress } from './layer';
import { causeOf, type Watched } from './release';

const MAX_DRAGS_PER_S = 60;
/** A hand that does not move repeats its message: after five seconds without one the server releases the bead. */
const STILL_THERE_MS = 500;

export interface Pointing {
  /** Pointer in CSS pixels of the canvas. */
  readonly px: Vec2;
  /** Largest distance from the bead at which this pointer grabs it. */
  readonly reachPx: number;
}

/** How pressed pointers and the wheel move a view. Places are in pixels. */
export interface Motion {
  /** The middle and the right button move it, too. */
  readonly allButtons?: true;
  move(effect: Effect & { type: 'move' }): void;
  pinch(effect: Effect & { type: 'pinch' }): void;
  /** Returns false if the wheel may scroll or zoom the page. */
  wheel(event: WheelEvent, delta_px: number, at: Vec2): boolean;
}

/** An open view. */
export interface Surface {
  /** Undefined while nothing may move the view. */
  readonly motion: () => Motion | undefined;
  /** Handles a key that moves the view. Returns false for other keys. */
  readonly key: (key: string) => boolean;
  /** Direction on the table of an arrow on the screen. */
  readonly turned: (arrow: Vec2) => Vec2;
  /** Whether the page shows the canvas turned by 90°, clockwise. */
  readonly isTurned?: () => boolean;
}

/** Picks a place for a form: the next click on the workspace, or Enter at its cursor. */
export interface Picker {
  readonly isPicking: Accessor<boolean>;
  /** Passes the next chosen place to `take`. */
  start(take: (at: Vec2) => void): void;
  /** Whether `take` waits for the next place. */
  isFor(take: (at: Vec2) => void): boolean;
  cancel(): void;
}

/** Where a goal was refused, and why. */
interface Refused {
  readonly at: Vec2;
  readonly words: string;
}

export interface Interaction {
  /** The mapping of the open view; undefined until its size is known. */
  readonly view: Accessor<TableView | undefined>;
  readonly setView: Setter<TableView | undefined>;
  readonly mode: Accessor<Mode>;
  /** What the pressed pointer or the keyboard does. */
  readonly act: Accessor<Act>;
  readonly step: (event: GestureEvent) => void;
  readonly picker: Picker;
  /** Whether this browser may act; shows a notice if not. */
  mayAct(): boolean;
  readonly setPointing: Setter<Pointing | undefined>;
  /** Whether a press would grab the bead. The bead may move while the pointer does not. */
  isAtBead(pointing: Pointing): boolean;
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
  /** What a press does now in place of setting the goal. */
  readonly press: Accessor<Press | undefined>;
  /** Whether it does that at the pointer. */
  readonly isPressable: Accessor<boolean>;
  readonly setGoal: (at: Vec2) => void;
  /** The last goal that was refused. */
  readonly refused: Accessor<Refused | undefined>;
  /** Called when a view opens and closes. */
  enter(surface: Surface): void;
  leave(): void;
}

export function createInteraction(
  lab: Session & Trial & Notices & Pick<ByHand, 'steering'>,
  layers: readonly LiveLayer[],
  grabPx?: number,
): Interaction {
  const [mode, setMode] = createSignal(REST);
  const act = createMemo(() => mode().act);
  const [view, setView] = createSignal<TableView>();
  const [pointing, setPointing] = createSignal<Pointing>();
  const [cursor, setCursor] = createSignal<Vec2>();
  const [focused, setFocused] = createSignal(false);
  const [refused, setRefused] = createSignal<Refused>();
  let surface: Surface | undefined;

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
  const setGoal = (at: Vec2): void => {
    const workspace = lab.scene()?.workspace;
    // Beside the table, a click means nothing.
    if (!workspace || distance(clampToRect(workspace, at), at) > 0) return;
    if (!mayAct()) return;
    void lab.send('workspace', { type: 'set_goal', x_m: at[0], y_m: at[1] }).then((answer) => {
      if (answer.kind === 'refused') setRefused({ at, words: refusalWords(answer.refusal) });
    });
  };
  const press = createMemo(() => shownPress(layers));
  const perform = (effect: Effect): void => {
    switch (effect.type) {
      case 'steer':
        lab.steering.point(effect.at);
        break;
      case 'lean':
        lab.steering.lean('keys', surface?.turned(effect.direction) ?? effect.direction);
        break;
      case 'place':
        (effect.take ?? press()?.at(effect.at) ?? setGoal)(effect.at);
        break;
      case 'refuse':
        mayAct();
        break;
      case 'drag': {
        const scene = lab.scene();
        if (scene) drags.offer({ at: clampToRect(scene.workspace, effect.at), lift: effect.lift });
        break;
      }
      case 'release':
        drags.flush();
        holds.stop();
        lab.stream({ type: 'release' });
        break;
      case 'move':
        surface?.motion()?.move(effect);
        break;
      case 'pinch':
        surface?.motion()?.pinch(effect);
        break;
    }
  };
  const run = (event: GestureEvent): void => {
    untrack(() => {
      const next = step(mode(), event);
      const said = lab.notices().workspace;
      // A new attempt.
      if (said && next.mode.act.kind === 'held' && act().kind !== 'held')
        lab.dismiss('workspace', said.id);
      setMode(next.mode);
      next.effects.forEach(perform);
    });
  };

  const isAtBead = ({ px, reachPx }: Pointing): boolean => {
    const bead_m = lab.state()?.bead_m;
    const bead = bead_m && view()?.toPx([bead_m[0], bead_m[1]], bead_m[2]);
    return bead !== undefined && distance(px, bead) <= reachPx;
  };
  const reachPx = createMemo(() => {
    const here = pointing();
    const canTake = lab.canOperate() && act().kind !== 'held';
    return here && canTake && isAtBead(here) ? here.reachPx : undefined;
  });
  const isPicking = createMemo(() => mode().take !== undefined);
  const isPressable = createMemo(() => {
    const px = pointing()?.px;
    const at = px && view()?.toWorld(px);
    return !isPicking() && at !== undefined && press()?.at(at) !== undefined;
  });

  createEffect<Watched | undefined>((before) => {
    const now: Watched = {
      canOperate: lab.canOperate(),
      silences: lab.silences(),
      trial: lab.scene()?.trial,
      tick: lab.state()?.tick ?? 0,
    };
    const cause = before && causeOf(before, now);
    if (cause) run({ type: 'end', cause });
    return now;
  }, undefined);
  createEffect(() => {
    if (!lab.steering.isActive()) run({ type: 'end', cause: 'steering over' });
  });
  // When the view changes, the place under a still pointer changes.
  createEffect(
    on(view, (now) => {
      const { act, fingers } = mode();
      const pointer =
        act.kind === 'steering' ? act.pointer : act.kind === 'held' ? act.by : undefined;
      const finger = fingers.find((one) => one.pointer === pointer);
      if (!now || !finger) return;
      const { px } = finger;
      const lift = act.kind === 'held' && act.lift;
      run({ type: 'move', pointer: finger.pointer, px, at: now.toWorld(px), lift });
    }),
  );

  return {
    view,
    setView,
    mode,
    act,
    step: run,
    picker: {
      isPicking,
      start: (take) => {
        run({ type: 'pick', take });
      },
      isFor: (take) => mode().take === take,
      cancel: () => {
        run({ type: 'pick' });
      },
    },
    mayAct,
    setPointing,
    isAtBead,
    grabPx,
    reachPx,
    press,
    isPressable,
    setGoal,
    refused,
    cursor,
    setCursor,
    focused,
    setFocused,
    at: () => {
      const px = pointing()?.px;
      if (px) return view()?.toWorld(px);
      return focused() ? cursor() : undefined;
    },
    enter: (opened) => {
      surface = opened;
    },
    leave: () => {
      run({ type: 'end', cause: 'view closed' });
      surface = undefined;
      setPointing(undefined);
      setFocused(false);
      setView(undefined);
    },
  };
}

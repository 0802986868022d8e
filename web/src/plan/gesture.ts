// What pressed pointers and held keys do on a view: steer the tool, pick a place or set the goal, drag the bead, or move
// the view. Pure. `px` is a pixel of the view, `at` its place on the table in metres; undefined beside the table.

import { distance, type Vec2 } from '../lab/geometry';
import type { End } from './release';

/** What holds the bead: a pointer by its id, or the keyboard. */
export type Holder = number | 'keyboard';

export type Act =
  /** Pressed pointers move the view: one moves or turns it, two zoom it. */
  | { readonly kind: 'idle' }
  | { readonly kind: 'steering'; readonly pointer: number }
  /** Neither a click nor a drag yet. */
  | {
      readonly kind: 'pressed';
      readonly pointer: number;
      readonly at: Vec2;
      readonly onBead: boolean;
    }
  | { readonly kind: 'held'; readonly by: Holder; readonly at: Vec2; readonly lift: boolean };

/** How one pointer moves a view in three dimensions. The map has only one way. */
export type Grip = 'turn' | 'shift' | 'dolly';

interface Finger {
  readonly pointer: number;
  readonly px: Vec2;
  readonly from_px: Vec2;
  /** A shorter movement is still a click. */
  readonly slop_px: number;
  readonly isBeyondSlop: boolean;
  readonly grip: Grip;
}

type Take = (at: Vec2) => void;

export interface Mode {
  readonly act: Act;
  /** Pressed pointers, in the order in which they were pressed. */
  readonly fingers: readonly Finger[];
  /** Pressed arrow keys that steer. */
  readonly arrows: readonly string[];
  /** Receives the next chosen place, which is then no goal. */
  readonly take?: Take | undefined;
}

export type GestureEvent =
  | {
      readonly type: 'down';
      readonly pointer: number;
      readonly px: Vec2;
      readonly at: Vec2 | undefined;
      readonly slop_px: number;
      readonly grip: Grip;
      /** Not the middle or right button, which only move the view. */
      readonly isMain: boolean;
      readonly onBead: boolean;
      readonly mayAct: boolean;
      /** Whether the hand steers the tool. */
      readonly steers: boolean;
    }
  | {
      readonly type: 'move';
      readonly pointer: number;
      readonly px: Vec2;
      readonly at: Vec2 | undefined;
      readonly lift: boolean;
    }
  | { readonly type: 'up'; readonly pointer: number }
  | { readonly type: 'lift'; readonly lift: boolean }
  /** The keyboard takes the bead, moves it, and puts it down. */
  | { readonly type: 'take'; readonly at: Vec2 }
  | { readonly type: 'carry'; readonly at: Vec2; readonly lift: boolean }
  | { readonly type: 'put' }
  /** An arrow key steers. */
  | { readonly type: 'arrow'; readonly key: string; readonly isDown: boolean }
  /** The next place is for `take`; without one, it is a goal again. */
  | { readonly type: 'pick'; readonly take?: Take | undefined }
  | { readonly type: 'place'; readonly at: Vec2 }
  | { readonly type: 'end'; readonly cause: End; readonly pointer?: number };

export type Effect =
  | { readonly type: 'steer'; readonly at: Vec2 }
  | { readonly type: 'lean'; readonly direction: Vec2 }
  | { readonly type: 'place'; readonly at: Vec2; readonly take: Take | undefined }
  | { readonly type: 'refuse' }
  | { readonly type: 'drag'; readonly at: Vec2; readonly lift: boolean }
  | { readonly type: 'release' }
  | {
      readonly type: 'move';
      readonly from: Vec2;
      readonly to: Vec2;
      /** Where the pointer was pressed. */
      readonly press: Vec2;
      readonly grip: Grip;
    }
  | { readonly type: 'pinch'; readonly from: Vec2; readonly to: Vec2; readonly other: Vec2 };

export interface Step {
  readonly mode: Mode;
  readonly effects: readonly Effect[];
}

const IDLE: Act = { kind: 'idle' };
export const REST: Mode = { act: IDLE, fingers: [], arrows: [] };

export const ARROWS: Partial<Record<string, Vec2>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

const done = (mode: Mode, ...effects: readonly Effect[]): Step => ({ mode, effects });
const pointerOf = (act: Act): Holder | undefined =>
  act.kind === 'idle' ? undefined : act.kind === 'held' ? act.by : act.pointer;

function hold(mode: Mode, by: Holder, at: Vec2, lift: boolean): Step {
  return done({ ...mode, act: { kind: 'held', by, at, lift } }, { type: 'drag', at, lift });
}

/** Ends a press or a hold. */
function letGo(mode: Mode): Step {
  const now = { ...mode, act: IDLE };
  return mode.act.kind === 'held' ? done(now, { type: 'release' }) : done(now);
}

const steer = (at: Vec2 | undefined): Effect[] => (at ? [{ type: 'steer', at }] : []);

function withArrows(mode: Mode, arrows: readonly string[]): Step {
  const sum = arrows.reduce<Vec2>(
    ([x, y], key) => [x + (ARROWS[key]?.[0] ?? 0), y + (ARROWS[key]?.[1] ?? 0)],
    [0, 0],
  );
  return done({ ...mode, arrows }, { type: 'lean', direction: sum });
}

function place(mode: Mode, at: Vec2): Step {
  return done({ ...mode, take: undefined }, { type: 'place', at, take: mode.take });
}

/** Another number of fingers begins another movement of the view. */
const others = (mode: Mode, pointer: number | undefined): Finger[] =>
  mode.fingers
    .filter((finger) => finger.pointer !== pointer)
    .map((finger) => ({ ...finger, from_px: finger.px, isBeyondSlop: false }));

function down(mode: Mode, event: GestureEvent & { type: 'down' }): Step {
  const { pointer, px, at, slop_px, grip, isMain, onBead } = event;
  // While one pointer steers, others do nothing.
  if (mode.act.kind === 'steering') return done(mode);
  const finger = { pointer, px, from_px: px, slop_px, isBeyondSlop: false, grip };
  if (isMain && event.steers && !mode.take) {
    const steering: Mode = { ...mode, act: { kind: 'steering', pointer }, fingers: [finger] };
    return done(steering, ...letGo(mode).effects, ...steer(at));
  }
  const now = { ...mode, fingers: [...others(mode, pointer), finger] };
  // Two fingers zoom, so the first one was neither a tap nor a drag.
  if (now.fingers.length > 1) return done(now.act.kind === 'pressed' ? { ...now, act: IDLE } : now);
  if (!isMain) return done(now);
  if (onBead && !event.mayAct) return done(now, { type: 'refuse' });
  return done(
    at && now.act.kind === 'idle' ? { ...now, act: { kind: 'pressed', pointer, at, onBead } } : now,
  );
}

/** What a moved finger does to the view. Of three fingers and more, the first two zoom. */
function moveView(fingers: readonly Finger[], from: Vec2, moved: Finger): Effect[] {
  const { px: to, from_px: press, grip } = moved;
  // The view has moved under a still finger.
  if (from === to) return [];
  if (fingers.length === 1)
    return moved.isBeyondSlop ? [{ type: 'move', from, to, press, grip }] : [];
  const [first, second] = fingers;
  const other = first === moved ? second : second === moved ? first : undefined;
  return other ? [{ type: 'pinch', from, to, other: other.px }] : [];
}

function move(mode: Mode, event: GestureEvent & { type: 'move' }): Step {
  const { pointer, px, at, lift } = event;
  const before = mode.fingers.find((finger) => finger.pointer === pointer);
  if (!before) return done(mode);
  const isBeyondSlop = before.isBeyondSlop || distance(before.from_px, px) > before.slop_px;
  const moved = { ...before, px, isBeyondSlop };
  const fingers = mode.fingers.map((finger) => (finger === before ? moved : finger));
  const now: Mode = { ...mode, fingers };
  const { act } = now;
  const view = (next: Step): Step => ({
    mode: next.mode,
    effects: [...next.effects, ...moveView(fingers, before.px, moved)],
  });
  if (pointerOf(act) !== pointer) return view(done(now));
  switch (act.kind) {
    case 'steering':
      return done(now, ...steer(at));
    case 'held': {
      const next = at ? hold(now, pointer, at, lift) : done(now);
      return fingers.length > 1 ? view(next) : next;
    }
    case 'pressed':
      if (!isBeyondSlop) return done(now);
      // A press that moved beside the bead is neither a click nor a drag.
      if (!act.onBead) return view(letGo(now));
      return at ? hold(now, pointer, at, lift) : done(now);
    default:
      return done(now);
  }
}

function without(mode: Mode, pointer: number | undefined): Mode {
  const isPressed = mode.fingers.some((finger) => finger.pointer === pointer);
  return isPressed ? { ...mode, fingers: others(mode, pointer) } : mode;
}

function end(mode: Mode, cause: End, pointer?: number): Step {
  const { act, arrows } = mode;
  const isOwn = pointer !== undefined && pointerOf(act) === pointer;
  const isSteering = act.kind === 'steering';
  switch (cause) {
    case 'capture lost':
      return isOwn ? letGo(without(mode, pointer)) : done(without(mode, pointer));
    case 'pointer cancelled':
      return isSteering && !isOwn ? done(mode) : letGo(without(mode, pointer));
    case 'steering over':
      return done(isSteering ? { ...REST, take: mode.take } : { ...mode, arrows: [] });
    case 'view closed':
      return done(REST, ...letGo(mode).effects);
    case 'canvas left':
    case 'window left': {
      const isHeldOn = isSteering || (cause === 'canvas left' && pointerOf(act) !== 'keyboard');
      const next = isHeldOn ? done(mode) : letGo(mode);
      if (arrows.length === 0) return next;
      const stopped = withArrows(next.mode, []);
      return done(stopped.mode, ...next.effects, ...stopped.effects);
    }
    case 'escape':
      return isSteering ? done({ ...mode, take: undefined }) : letGo({ ...mode, take: undefined });
    default:
      return isSteering ? done(mode) : letGo(mode);
  }
}

export function step(mode: Mode, event: GestureEvent): Step {
  const { act, arrows } = mode;
  switch (event.type) {
    case 'down':
      return down(mode, event);
    case 'move':
      return move(mode, event);
    case 'up': {
      const now = without(mode, event.pointer);
      if (pointerOf(act) !== event.pointer) return done(now);
      return act.kind === 'pressed' ? place({ ...now, act: IDLE }, act.at) : letGo(now);
    }
    case 'lift':
      return act.kind === 'held' && act.lift !== event.lift
        ? hold(mode, act.by, act.at, event.lift)
        : done(mode);
    case 'take':
      return act.kind === 'idle' ? hold(mode, 'keyboard', event.at, false) : done(mode);
    case 'carry':
      return pointerOf(act) === 'keyboard'
        ? hold(mode, 'keyboard', event.at, event.lift)
        : done(mode);
    case 'put':
      return pointerOf(act) === 'keyboard' ? letGo(mode) : done(mode);
    case 'arrow': {
      const rest = arrows.filter((key) => key !== event.key);
      if (!event.isDown && rest.length === arrows.length) return done(mode);
      return withArrows(mode, event.isDown ? [...rest, event.key] : rest);
    }
    case 'pick':
      return done({ ...mode, take: event.take });
    case 'place':
      return place(mode, event.at);
    case 'end':
      return end(mode, event.cause, event.pointer);
  }
}

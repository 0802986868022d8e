// The layout of a gamepad that the browser does not know, from what the user pushes when asked for a direction. Pure.
//
// Firefox on Linux knows few pads: triggers rest at −1, or at 0 until they are touched, and the cross may be axes or buttons.
// So nothing counts before it was pushed on request, and an axis that does not return to its place does not steer.

import type { Vec2 } from '../../lab/geometry';
import { type Pad, stick } from './gamepad';

/** In the order in which the user is asked; an axis answers for two. */
const DIRECTIONS = ['right', 'up', 'left', 'down'] as const;
export type Direction = (typeof DIRECTIONS)[number];
const OPPOSITE = { right: 'left', left: 'right', up: 'down', down: 'up' } as const;
/** An axis is pushed from here on. */
const PUSHED = 0.5;
/** An axis that moves less for so long is steady. */
const STEADY = 0.05;
const STEADY_MS = 200;
/** Held for longer, a push is the rest of a trigger. */
const PUSH_MS = 3000;
/** The first button stops the tool. */
const STOP = 0;

type Source =
  | { readonly axis: number; readonly sign: number; readonly rest: number }
  | { readonly button: number };

interface Axis {
  readonly value: number;
  /** Since when it has had this value. */
  readonly since_ms: number;
  /** Where it was first or was last steady, if that is near the middle; otherwise NaN. */
  readonly rest: number;
}

export interface Layout {
  readonly sources: Readonly<Partial<Record<Direction, Source>>>;
  /** What was pushed last, until it is released. */
  readonly pushed?: { readonly direction: Direction; readonly since_ms: number };
  readonly axes: readonly Axis[];
}

export const UNKNOWN: Layout = { sources: {}, axes: [] };

/** The direction that the user should push next; undefined if all are there. */
export function wanted({ sources }: Layout): Direction | undefined {
  return DIRECTIONS.find((direction) => !(direction in sources));
}

const restAt = (value: number): number => (Math.abs(value) < PUSHED ? value : NaN);

function followed(before: Axis | undefined, value: number, now_ms: number): Axis {
  if (!before) return { value, since_ms: now_ms, rest: restAt(value) };
  if (!(Math.abs(value - before.value) <= STEADY))
    return { value, since_ms: now_ms, rest: before.rest };
  return now_ms - before.since_ms < STEADY_MS ? before : { ...before, rest: restAt(before.value) };
}

/** What is pushed now and answers for no direction yet. */
function newSource({ sources, axes }: Layout, { buttons }: Pad): Source | undefined {
  const used = Object.values(sources);
  const axis = axes.findIndex(
    ({ value, rest }, index) =>
      Math.abs(value - rest) > PUSHED && !used.some((one) => 'axis' in one && one.axis === index),
  );
  const found = axes[axis];
  if (found) return { axis, sign: Math.sign(found.value - found.rest), rest: found.rest };
  const button = buttons.findIndex(
    ({ pressed }, index) =>
      pressed && index !== STOP && !used.some((one) => 'button' in one && one.button === index),
  );
  return button < 0 ? undefined : { button };
}

/** Ends a push that was released, or that comes from a trigger. */
function afterPush(layout: Layout, { buttons }: Pad, now_ms: number): Layout {
  const { sources, pushed, axes } = layout;
  const source = pushed && sources[pushed.direction];
  if (!source) return layout;
  if ('button' in source) return buttons[source.button]?.pressed ? layout : { sources, axes };
  const { axis, sign } = source;
  const { value, since_ms, rest } = axes[axis] ?? { value: NaN, since_ms: NaN, rest: NaN };
  const isReleased = Math.abs(value - rest) <= STEADY && since_ms > pushed.since_ms;
  if (isReleased) {
    const opposite = { [OPPOSITE[pushed.direction]]: { axis, sign: -sign, rest } };
    return { sources: { ...sources, [pushed.direction]: { axis, sign, rest }, ...opposite }, axes };
  }
  const isTrigger = !(value * sign > -PUSHED) || now_ms - pushed.since_ms > PUSH_MS;
  if (!isTrigger) return layout;
  const others = Object.entries(sources).filter(([name]) => name !== pushed.direction);
  return {
    sources: Object.fromEntries(others),
    axes: axes.with(axis, { value, since_ms, rest: NaN }),
  };
}

/** The layout after one more look at the gamepad. */
export function learned(before: Layout, pad: Pad, now_ms: number): Layout {
  const axes = pad.axes.map((value, index) => followed(before.axes[index], value, now_ms));
  const layout = { ...before, axes };
  if (before.pushed) return afterPush(layout, pad, now_ms);
  const direction = wanted(layout);
  const source = direction && newSource(layout, pad);
  if (!source) return layout;
  const sources = { ...layout.sources, [direction]: source };
  return { ...layout, sources, pushed: { direction, since_ms: now_ms } };
}

/** The direction of a gamepad by its layout; `hold` while its first button is pressed. */
export function readBy({ sources }: Layout, { axes, buttons }: Pad): Vec2 | 'hold' {
  if (buttons[STOP]?.pressed) return 'hold';
  const share = (direction: Direction): number => {
    const source = sources[direction];
    if (!source) return 0;
    if ('button' in source) return buttons[source.button]?.pressed ? 1 : 0;
    return Math.max(0, ((axes[source.axis] ?? NaN) - source.rest) * source.sign);
  };
  return stick(share('right') - share('left'), share('down') - share('up'));
}

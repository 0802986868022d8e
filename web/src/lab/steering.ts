// The tool in the user's hand, with the controller You: pointer, keys and gamepad point it to places.

import { createEffect, createMemo, createSignal, on, onCleanup } from 'solid-js';
import { Limiter } from '../net/limiter';
import { clampToRect, type Vec2 } from './geometry';
import type { Basis } from './basis';
import { isOver } from './contest';

const MOST_PER_S = 60;
/** A direction points this far ahead of the tool: at full speed it gets there in .6 s. */
const LEAD_M = 0.025;
const LEAN_MS = 50;

export type Device = 'keys' | 'gamepad';

/** The sum of all devices, with a length of at most 1. */
export function joined(directions: Iterable<Vec2>): Vec2 {
  let [x, y] = [0, 0];
  for (const [dx, dy] of directions) [x, y] = [x + dx, y + dy];
  const length = Math.hypot(x, y);
  return length > 1 ? [x / length, y / length] : [x, y];
}

export type Steering = ReturnType<typeof createSteering>;

export function createSteering(lab: Pick<Basis, 'scene' | 'state' | 'canOperate' | 'stream'>) {
  const [target, setTarget] = createSignal<Vec2>();
  const [approach, setApproach] = createSignal(false);
  const leans = new Map<Device, Vec2>();
  let timer: ReturnType<typeof setInterval> | undefined;
  const isActive = createMemo(() => lab.state()?.controller === 'you' && lab.canOperate());
  /** Then nothing moves any more. */
  const hasEnded = createMemo(() => isOver(lab.state()?.attempt ?? undefined));
  const steers = new Limiter<Vec2>(1000 / MOST_PER_S, ([x_m, y_m]) => {
    if (isActive()) lab.stream({ type: 'steer', x_m, y_m, approach: approach() });
  });
  const point = (at: Vec2): void => {
    const scene = lab.scene();
    if (!scene || !isActive() || hasEnded()) return;
    const place = clampToRect(scene.workspace, at);
    setTarget(place);
    steers.offer(place);
  };
  const tool = (): Vec2 | undefined => {
    const state = lab.state();
    return state && [state.tool_m[0], state.tool_m[1]];
  };
  const ahead = (): void => {
    const [from, [x, y]] = [tool(), joined(leans.values())];
    if (from) point([from[0] + x * LEAD_M, from[1] + y * LEAD_M]);
  };
  const stop = (): void => {
    clearInterval(timer);
    timer = undefined;
  };
  const forget = (): void => {
    leans.clear();
    stop();
    setTarget(undefined);
  };
  // A rewind sends the scene again: the rewound state says where the tool is pointed.
  createEffect(on([isActive, lab.scene, hasEnded], forget));
  onCleanup(stop);
  return {
    /** Whether the hand steers: the controller is You, and this browser operates. */
    isActive,
    /** Where this browser points; undefined if it does not. */
    target,
    /** Whether the hand also steers while sub-controller 1 is active. */
    approach,
    setApproach: (isOn: boolean) => {
      setApproach(isOn);
      const at = target();
      if (at) point(at);
    },
    point: (at: Vec2) => {
      leans.clear();
      stop();
      point(at);
    },
    /** A direction on the table with a length of at most 1; 0 stops the tool. */
    lean: (device: Device, direction: Vec2) => {
      const before = leans.get(device) ?? [0, 0];
      if (!isActive() || (before[0] === direction[0] && before[1] === direction[1])) return;
      leans.set(device, direction);
      ahead();
      const [x, y] = joined(leans.values());
      if (x === 0 && y === 0) stop();
      else timer ??= setInterval(ahead, LEAN_MS);
    },
    /** Stops the tool where it is. */
    hold: () => {
      leans.clear();
      stop();
      const at = tool();
      if (at) point(at);
    },
  };
}

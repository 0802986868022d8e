// The pressed pointers: one moves the plan, two zoom it. Pure; places are in pixels.

import { distance, type Vec2 } from '../lab/geometry';

/** A shorter movement of a finger may still be a tap. */
const SLOP_PX = 8;

export type Gesture =
  | { readonly type: 'pan'; readonly by: Vec2 }
  /** `at` stays in its place. */
  | { readonly type: 'zoom'; readonly at: Vec2; readonly by: number };

export class Pressed {
  /** In the order in which they were pressed. */
  private readonly places = new Map<number, Vec2>();
  private moved_px = 0;

  /** Returns whether it is not the only one. */
  press(pointer: number, at: Vec2): boolean {
    this.places.set(pointer, at);
    this.moved_px = 0;
    return this.places.size > 1;
  }

  /** What a movement does. Of three fingers and more, the first two zoom. */
  move(pointer: number, to: Vec2): Gesture | undefined {
    const from = this.places.get(pointer);
    if (!from) return undefined;
    this.places.set(pointer, to);
    if (this.places.size === 1) {
      this.moved_px += distance(from, to);
      if (this.moved_px < SLOP_PX) return undefined;
      return { type: 'pan', by: [to[0] - from[0], to[1] - from[1]] };
    }
    const [first, second] = [...this.places];
    const isFirst = first?.[0] === pointer;
    if (!isFirst && second?.[0] !== pointer) return undefined;
    const at = (isFirst ? second : first)?.[1];
    return at && { type: 'zoom', at, by: distance(to, at) / Math.max(1, distance(from, at)) };
  }

  forget(pointer: number): void {
    this.places.delete(pointer);
  }
}

// Pointer and arrow keys on the workspace while the hand steers: they come before those that set goals, move the bead
// and zoom.

import { createEffect, on } from 'solid-js';
import type { TableView, Vec2 } from '../lab/geometry';
import type { Steering } from '../lab/steering';
import type { Shortcut } from '../ui/shortcuts';
import { ARROWS } from './keyboard';

/** Shown in the help. */
export const STEER_SHORTCUTS: readonly Shortcut[] = [
  {
    group: 'Workspace',
    keys: ['ArrowLeft', 'ArrowUp', 'ArrowRight', 'ArrowDown'],
    does: 'with the controller You: steer the tool while they are pressed',
  },
];

/** Keys that set goals and drag the bead. */
const OTHER_KEYS = new Set(['Enter', 'd', 'D']);

export interface SteerSurface {
  readonly view: () => TableView | undefined;
  /** Whether the next press chooses a place for something else. */
  readonly isPicking: () => boolean;
  /** Whether only the steering may do something. */
  readonly isAtStake: () => boolean;
  readonly onPointing: (px: Vec2) => void;
  /** Direction on the table of an arrow on the screen. */
  readonly turned: (arrow: Vec2) => Vec2;
}

/** Listens until `signal` aborts. Called before all other listeners of the canvas are added. */
export function attachSteering(
  canvas: HTMLCanvasElement,
  steering: Steering,
  surface: SteerSurface,
  signal: AbortSignal,
): void {
  let pointer: number | undefined;
  let at_px: Vec2 = [0, 0];
  let last: PointerEvent | undefined;
  const pressed = new Set<string>();
  const listen = (type: string, listener: (event: Event) => void): void => {
    canvas.addEventListener(type, listener, { signal });
  };
  const follow = (): void => {
    const at = surface.view()?.toWorld(at_px);
    if (at) steering.point(at);
  };
  const point = (event: PointerEvent): void => {
    const box = canvas.getBoundingClientRect();
    at_px = [event.clientX - box.left, event.clientY - box.top];
    last = event;
    surface.onPointing(at_px);
    follow();
  };
  /** The same movement can come twice: at once, and with the next frame. */
  const move = (event: PointerEvent): void => {
    if (event.clientX !== last?.clientX || event.clientY !== last.clientY) point(event);
  };
  const onPointer = (type: string, act: (event: PointerEvent) => void): void => {
    listen(type, (event) => {
      if (!(event instanceof PointerEvent) || pointer === undefined) return;
      event.stopImmediatePropagation();
      if (event.pointerId === pointer) act(event);
    });
  };
  listen('pointerdown', (event) => {
    if (!(event instanceof PointerEvent)) return;
    if (pointer !== undefined) {
      event.stopImmediatePropagation();
      return;
    }
    if (!steering.isActive() || surface.isPicking() || event.button !== 0) return;
    event.stopImmediatePropagation();
    pointer = event.pointerId;
    canvas.setPointerCapture(pointer);
    canvas.focus({ preventScroll: true });
    point(event);
  });
  onPointer('pointermove', move);
  // Where it exists, it does not wait for the next frame, as the other does.
  onPointer('pointerrawupdate', move);
  const end = (): void => {
    pointer = undefined;
  };
  for (const type of ['pointerup', 'pointercancel', 'lostpointercapture']) onPointer(type, end);

  const lean = (): void => {
    const arrows = [...pressed].map((key) => ARROWS[key] ?? [0, 0]);
    const [x, y] = arrows.reduce(([a, b], [dx, dy]) => [a + dx, b + dy], [0, 0]);
    steering.lean('keys', x === 0 && y === 0 ? [0, 0] : surface.turned([x, y]));
  };
  const release = (): void => {
    if (pressed.size === 0) return;
    pressed.clear();
    lean();
  };
  listen('keydown', (event) => {
    if (!(event instanceof KeyboardEvent) || !steering.isActive()) return;
    if (surface.isAtStake() && OTHER_KEYS.has(event.key)) {
      event.preventDefault();
      event.stopImmediatePropagation();
      return;
    }
    if (!ARROWS[event.key]) return;
    if (event.ctrlKey || event.altKey || event.metaKey || surface.isPicking()) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    pressed.add(event.key);
    lean();
  });
  listen('keyup', (event) => {
    if (event instanceof KeyboardEvent && pressed.delete(event.key)) lean();
  });
  listen('blur', release);
  window.addEventListener('blur', release, { signal });
  // When the view moves, the place under a still pointer changes.
  createEffect(
    on(
      surface.view,
      () => {
        if (pointer !== undefined) follow();
      },
      { defer: true },
    ),
  );
  createEffect(
    on(steering.isActive, (isActive) => {
      if (isActive) return;
      pressed.clear();
      pointer = undefined;
    }),
  );
}

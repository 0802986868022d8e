// Mouse, pen, fingers and keys on a view: the only listeners of its canvas. They feed the gestures.

import { isAtStake } from '../lab/contest';
import { clampToRect, distance, type Vec2 } from '../lab/geometry';
import type { ByHand, Session, Trial } from '../lab/slices';
import type { Shortcut } from '../ui/shortcuts';
import { ARROWS } from './gesture';
import type { Interaction, Surface } from './interaction';
import type { End } from './release';

const ARROW_KEYS = ['ArrowLeft', 'ArrowUp', 'ArrowRight', 'ArrowDown'] as const;

/** Shown in the help. The canvas handles these keys itself. */
export const WORKSPACE_SHORTCUTS: readonly Shortcut[] = (
  [
    [ARROW_KEYS, 'move the cursor, or the grabbed bead (Shift: over walls)'],
    [['Enter'], 'set the goal, or pick the place, at the cursor'],
    [['d'], 'grab or release the bead'],
    [['Escape'], 'release the bead, cancel picking'],
    [ARROW_KEYS, 'with the controller You: steer the tool while they are pressed'],
    [['+', '-'], 'zoom the plan, like the wheel (with Ctrl in a small window)'],
    [['Home'], 'show the whole plan'],
  ] as const
).map(([keys, does]) => ({ group: 'Workspace', keys, does }));

/** Largest distance from the bead at which a press grabs it. */
export const GRAB_PX = { mouse: 22, touch: 28 };
/** A shorter movement is still a click. Larger for a finger, because a fingertip rolls. */
const SLOP_PX = { mouse: 3, touch: 8 };
/** Way of the wheel for each unit of `deltaMode`: pixels, lines, pages. */
const WHEEL_PX = [1, 16, 100];
const STEP_M = 0.005;
/** Nearer than this to the bead, the cursor stays in place when the hand grabs the bead. */
const REACH_M = 0.02;

type Events = HTMLElementEventMap & DocumentEventMap & { pointerrawupdate: PointerEvent };

const kindOf = (event: PointerEvent): 'touch' | 'mouse' =>
  event.pointerType === 'touch' ? 'touch' : 'mouse';
const hasModifier = (event: KeyboardEvent): boolean =>
  event.ctrlKey || event.altKey || event.metaKey;

const isSameMovement = (a: PointerEvent, b: PointerEvent | undefined): boolean =>
  a.pointerId === b?.pointerId &&
  a.clientX === b.clientX &&
  a.clientY === b.clientY &&
  a.buttons === b.buttons;

/** Listens until `signal` aborts. */
export function attachInput(
  canvas: HTMLCanvasElement,
  lab: Pick<Session, 'canOperate'> & Trial & Pick<ByHand, 'steering'>,
  interaction: Interaction,
  surface: Surface,
  signal: AbortSignal,
): void {
  const { step, view, mode, setPointing } = interaction;
  /** The last movement. */
  let handled: PointerEvent | undefined;
  const listen = <K extends keyof Events>(
    target: EventTarget,
    types: readonly K[],
    listener: (event: Events[K]) => void,
  ): void => {
    for (const type of types) {
      target.addEventListener(type, listener as EventListener, { signal, passive: false });
    }
  };
  const end = (cause: End, pointer?: number): void => {
    step({ type: 'end', cause, ...(pointer !== undefined && { pointer }) });
  };
  const placeOf = (event: MouseEvent): Vec2 => {
    const box = canvas.getBoundingClientRect();
    if (surface.isTurned?.()) return [event.clientY - box.top, box.right - event.clientX];
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const point = (event: PointerEvent, px: Vec2): void => {
    const isSteering = mode().act.kind === 'steering';
    const reachPx = interaction.grabPx ?? GRAB_PX[kindOf(event)];
    setPointing({ px, reachPx: isSteering ? 0 : reachPx });
  };
  /** Whether another pointer steers: then this one does nothing. */
  const isOther = ({ pointerId }: PointerEvent): boolean => {
    const { act } = mode();
    return act.kind === 'steering' && act.pointer !== pointerId;
  };

  listen(canvas, ['pointerdown'], (event) => {
    const isMain = event.button === 0;
    if (isOther(event) || !(isMain || surface.motion()?.allButtons)) return;
    // Its release is noticed outside, too.
    canvas.setPointerCapture(event.pointerId);
    const px = placeOf(event);
    const shifts = (event.ctrlKey || event.metaKey || event.shiftKey) !== (event.button === 2);
    const reachPx = interaction.grabPx ?? GRAB_PX[kindOf(event)];
    step({
      type: 'down',
      pointer: event.pointerId,
      px,
      at: view()?.toWorld(px),
      slop_px: isMain ? SLOP_PX[kindOf(event)] : 0,
      grip: event.button === 1 ? 'dolly' : shifts ? 'shift' : 'turn',
      isMain,
      onBead: interaction.isAtBead({ px, reachPx }),
      mayAct: lab.canOperate(),
      steers: lab.steering.isActive(),
    });
    if (mode().act.kind === 'steering') canvas.focus({ preventScroll: true });
    point(event, px);
  });
  // Where it exists, `pointerrawupdate` does not wait for the next frame, as the other does.
  listen(canvas, ['pointermove', 'pointerrawupdate'], (event) => {
    const { act, fingers } = mode();
    const isSteering = act.kind === 'steering';
    if (isOther(event) || (event.type === 'pointerrawupdate' && !isSteering)) return;
    // The same movement comes twice: at once, and with the next frame. To measure its place again would cost a layout.
    if (isSteering && isSameMovement(event, handled)) return;
    handled = event;
    const { pointerId: pointer, shiftKey: lift } = event;
    const px = placeOf(event);
    const before = fingers.find((finger) => finger.pointer === pointer);
    if (before) {
      if (event.buttons === 0) end('capture lost', pointer);
      else step({ type: 'move', pointer, px, at: view()?.toWorld(px), lift });
    }
    point(event, px);
  });
  listen(canvas, ['pointerup'], ({ pointerId }) => {
    step({ type: 'up', pointer: pointerId });
  });
  listen(canvas, ['pointercancel'], ({ pointerId }) => {
    end('pointer cancelled', pointerId);
  });
  listen(canvas, ['lostpointercapture'], ({ pointerId }) => {
    end('capture lost', pointerId);
  });
  listen(canvas, ['pointerleave'], () => {
    setPointing(undefined);
  });
  // A long press of a finger that holds the bead opens no menu.
  listen(canvas, ['contextmenu'], (event) => {
    if (mode().act.kind !== 'idle' || surface.motion()?.allButtons) event.preventDefault();
  });
  listen(canvas, ['wheel'], (event) => {
    const delta_px = event.deltaY * (WHEEL_PX[event.deltaMode] ?? 1);
    if (surface.motion()?.wheel(event, delta_px, placeOf(event))) event.preventDefault();
  });
  listen(canvas, ['focus'], () => {
    interaction.setFocused(true);
  });
  listen(canvas, ['blur'], () => {
    interaction.setFocused(false);
    end('canvas left');
  });
  listen(window, ['blur'], () => {
    end('window left');
  });
  listen(document, ['visibilitychange'], () => {
    if (document.hidden) end('page hidden');
  });
  listen(window, ['keydown', 'keyup'], (event) => {
    if (event.key === 'Shift') step({ type: 'lift', lift: event.type === 'keydown' });
  });

  const bead = (): Vec2 | undefined => {
    const state = lab.state();
    return state && [state.bead_m[0], state.bead_m[1]];
  };
  const moveCursor = ([x, y]: Vec2, lift: boolean): void => {
    const scene = lab.scene();
    const from = interaction.cursor() ?? bead();
    if (!scene || !from) return;
    const to = clampToRect(scene.workspace, [from[0] + x * STEP_M, from[1] + y * STEP_M]);
    interaction.setCursor(to);
    step({ type: 'carry', at: to, lift });
  };
  const takeOrPut = (): void => {
    const { act } = mode();
    const at = bead();
    if (act.kind === 'held' && act.by === 'keyboard') {
      step({ type: 'put' });
    } else if (at && interaction.mayAct()) {
      // A distant cursor jumps to the bead first, so that grabbing does not fling the bead across the map.
      const here = interaction.cursor();
      const from = here && distance(here, at) <= REACH_M ? here : at;
      interaction.setCursor(from);
      step({ type: 'take', at: from });
    }
  };
  /** Returns false for keys of the page. */
  const onKey = (event: KeyboardEvent): boolean => {
    const { key } = event;
    const arrow = ARROWS[key];
    const steers = lab.steering.isActive();
    // During an attempt only the steering may do something.
    if (steers && isAtStake(lab) && ['Enter', 'd', 'D'].includes(key)) return true;
    if (hasModifier(event)) return false;
    if (arrow && steers && !interaction.picker.isPicking()) {
      step({ type: 'arrow', key, isDown: true });
    } else if (arrow) {
      moveCursor(surface.turned(arrow), event.shiftKey);
    } else if (key === 'Enter') {
      const at = interaction.cursor();
      // A held key does not set a second goal.
      if (!at || event.repeat) return false;
      step({ type: 'place', at });
    } else if (key === 'd' || key === 'D') {
      // A held key grabs only once.
      if (!event.repeat) takeOrPut();
    } else if (key === 'Escape') {
      end('escape');
    } else {
      return surface.key(key);
    }
    return true;
  };
  listen(canvas, ['keydown'], (event) => {
    if (onKey(event)) event.preventDefault();
  });
  listen(canvas, ['keyup'], ({ key }) => {
    step({ type: 'arrow', key, isDown: false });
  });
}

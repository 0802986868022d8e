// All causes that end a press or a hold, besides the end of the gesture.

import { createEffect, untrack } from 'solid-js';
import type { Session, Trial } from '../lab/slices';
import type { DragState, Holder } from './drag';

const always = (): boolean => true;
const holds = (drag: DragState, by: Holder): boolean => drag.kind === 'held' && drag.by === by;

/** Whether a cause ends a drag. `pointer` is the pointer of the event. */
const ENDS = {
  /** After a lost connection the server has released the bead. A viewer may not hold it. */
  'control lost': always,
  /** The server has released the bead because it received nothing from the hand. The hand must not grab it again. */
  'hand silent': always,
  'other trial': always,
  'session rewound': always,
  'view closed': always,
  'window left': always,
  'page hidden': always,
  'pointer cancelled': always,
  escape: always,
  /** Only the pointer of the drag has this capture, not a second finger or the keyboard. */
  'capture lost': (drag: DragState, pointer?: number) =>
    pointer !== undefined &&
    ((drag.kind === 'pressed' && drag.pointer === pointer) || holds(drag, pointer)),
  /** Two fingers turn the view, so the first one was not a click. */
  'second finger': ({ kind }: DragState) => kind === 'pressed',
  'canvas left': (drag: DragState) => holds(drag, 'keyboard'),
} satisfies Record<string, (drag: DragState, pointer?: number) => boolean>;

export type ReleaseCause = keyof typeof ENDS;
export const RELEASE_CAUSES = Object.keys(ENDS) as readonly ReleaseCause[];

export function ends(cause: ReleaseCause, drag: DragState, pointer?: number): boolean {
  return ENDS[cause](drag, pointer);
}

export type Release = (cause: ReleaseCause, pointer?: number) => void;

export interface Watched {
  readonly canOperate: boolean;
  readonly silences: number;
  readonly trial: number | undefined;
  readonly tick: number;
}

/** The cause of a release that follows from a change of the laboratory. */
export function causeOf(before: Watched, now: Watched): ReleaseCause | undefined {
  if (before.canOperate && !now.canOperate) return 'control lost';
  if (now.silences !== before.silences) return 'hand silent';
  if (now.trial !== before.trial) return 'other trial';
  if (now.tick < before.tick) return 'session rewound';
  return undefined;
}

/** Releases for the causes that come from the server. */
export function releaseWithLab(lab: Session & Trial, release: Release): void {
  createEffect<Watched | undefined>((before) => {
    const now: Watched = {
      canOperate: lab.canOperate(),
      silences: lab.silences(),
      trial: lab.scene()?.trial,
      tick: lab.state()?.tick ?? 0,
    };
    const cause = before && causeOf(before, now);
    if (cause) {
      untrack(() => {
        release(cause);
      });
    }
    return now;
  }, undefined);
}

/** Releases for the causes that come from the browser, until `signal` aborts. */
export function releaseWithPage(
  canvas: HTMLCanvasElement,
  release: Release,
  signal: AbortSignal,
): void {
  const on = (target: EventTarget, type: string, listener: () => void): void => {
    target.addEventListener(type, listener, { signal });
  };
  on(window, 'blur', () => {
    release('window left');
  });
  on(document, 'visibilitychange', () => {
    if (document.hidden) release('page hidden');
  });
  on(canvas, 'pointercancel', () => {
    release('pointer cancelled');
  });
  on(canvas, 'blur', () => {
    release('canvas left');
  });
  canvas.addEventListener(
    'lostpointercapture',
    ({ pointerId }) => {
      release('capture lost', pointerId);
    },
    { signal },
  );
}

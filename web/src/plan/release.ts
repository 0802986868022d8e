// When the hand releases what it holds or presses, besides at the end of a gesture: every cause, in one place.

import { createEffect, untrack } from 'solid-js';
import type { Session, Trial } from '../lab/slices';
import type { DragState, Holder } from './drag';

const always = (): boolean => true;
const holds = (drag: DragState, by: Holder): boolean => drag.kind === 'held' && drag.by === by;

/** Whether a cause ends a drag; `pointer` is the one that the cause is about. */
const ENDS = {
  /** A lost connection has released the bead on the server; a lost role may not hold it. */
  'control lost': always,
  /** The server has released the bead, as it received nothing of the hand: it must not be taken again. */
  'hand silent': always,
  'other trial': always,
  'time turned back': always,
  'view closed': always,
  'window left': always,
  'page hidden': always,
  'pointer cancelled': always,
  escape: always,
  /** Neither a second finger nor the keyboard's hold has this capture. */
  'capture lost': (drag: DragState, pointer?: number) =>
    pointer !== undefined &&
    ((drag.kind === 'pressed' && drag.pointer === pointer) || holds(drag, pointer)),
  /** Two fingers turn the view: the first one was no click. */
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

/** What the laboratory's change means for a hold. */
export function causeOf(before: Watched, now: Watched): ReleaseCause | undefined {
  if (before.canOperate && !now.canOperate) return 'control lost';
  if (now.silences !== before.silences) return 'hand silent';
  if (now.trial !== before.trial) return 'other trial';
  if (now.tick < before.tick) return 'time turned back';
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

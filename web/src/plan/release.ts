// What ends a press or a hold, besides the end of the gesture. Pure.

export type End =
  | 'capture lost'
  | 'pointer cancelled'
  /** After a lost connection the server has released the bead. A viewer may not hold it. */
  | 'control lost'
  /** The server has released the bead because it received nothing from the hand. The hand must not grab it again. */
  | 'hand silent'
  | 'other trial'
  | 'session rewound'
  | 'steering over'
  | 'view closed'
  | 'window left'
  | 'page hidden'
  | 'canvas left'
  | 'escape';

export interface Watched {
  readonly canOperate: boolean;
  readonly silences: number;
  readonly trial: number | undefined;
  readonly tick: number;
}

/** The cause of an end that follows from a change of the laboratory. */
export function causeOf(before: Watched, now: Watched): End | undefined {
  if (before.canOperate && !now.canOperate) return 'control lost';
  if (now.silences !== before.silences) return 'hand silent';
  if (now.trial !== before.trial) return 'other trial';
  if (now.tick < before.tick) return 'session rewound';
  return undefined;
}

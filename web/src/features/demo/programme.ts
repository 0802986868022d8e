// The programme of the demonstration: experiments with captions, one after the other. Pure.

import type { ClientMessage, StateMessage } from '../../net/protocol.gen';
import { MAIN, sessionOf } from '../../net/session';
import { addressOf } from '../../net/base';

/** Something that happens when a state fits: a caption, and maybe a command. */
export interface Cue {
  /** Holds in no state before its turn, so that a cue after a missed one can follow at once. */
  readonly when: (state: StateMessage) => boolean;
  readonly caption: string;
  /** Whether the caption is true. One that is true no more gives way at once. */
  readonly holds: (state: StateMessage) => boolean;
  readonly commands?: readonly ClientMessage[];
}

export interface Part {
  readonly title: string;
  /** The hash of an experiment link; undefined for the easy challenge of the day. */
  readonly link?: string;
  /** Playback speed of the experiment. */
  readonly speed?: number;
  readonly cues: readonly Cue[];
}

/** In a new leg: the leg in which the bead was pulled away has `steps` steps or more. */
const carriesOn =
  (steps: number) =>
  ({ phase, disturbances, leg_steps }: StateMessage): boolean =>
    disturbances > 0 && phase.code === 'transporting' && leg_steps < steps;
const isCarried = ({ mode }: StateMessage): boolean => mode === 2;
const isFetched = ({ mode }: StateMessage): boolean => mode === 1;
const DELIVERED: Cue = {
  when: ({ deliveries }) => deliveries > 0,
  caption: 'Delivered.',
  holds: ({ mode, phase }) => mode === 2 && phase.code === 'delivered',
};
/** Not at the end of the transport: a bead that was delivered is not pulled away. */
const after =
  (steps: number) =>
  ({ phase, leg_steps }: StateMessage): boolean =>
    phase.code === 'transporting' && leg_steps >= steps;
const atSpeed = (factor: number): ClientMessage => ({ type: 'set_speed', factor });

/** Slow enough to see and read what happens between the warning and the next transport. */
const PULL_SPEED = 0.5;
/** Steps from the warning to the pull: four seconds at that speed. */
const WARNING_STEPS = 8;

/**
 * The bead is pulled away after some steps of a transport, fetched, and delivered. The experiment's script pulls, so that
 * it happens at its step, however late this page is.
 */
function disturbed(carries: string, speed: number, steps: number): readonly Cue[] {
  return [
    { when: after(0.3 * steps), caption: carries, holds: isCarried },
    {
      when: after(steps - WARNING_STEPS),
      caption: 'Watch: the bead will be pulled away.',
      holds: isCarried,
      commands: [atSpeed(PULL_SPEED)],
    },
    {
      // The loss is noticed later.
      when: (state) => state.disturbances > 0 && isFetched(state),
      caption: 'The bead is pulled away. The arm flies straight to it.',
      holds: isFetched,
    },
    {
      when: carriesOn(steps),
      caption: 'Fetched. It carries on.',
      holds: (state) => isCarried(state) && !DELIVERED.holds(state),
      commands: [atSpeed(speed)],
    },
    DELIVERED,
  ];
}

const COLON = '#v=1&map=colon&seed=1&start=0.19,-0.28';
const pull = (x_m: number, y_m: number, step: number): string =>
  `&script=displace:${x_m},${y_m}@step:${step}`;

/** How long the ghosts are shown. */
const GHOSTS_S = 20;

export const PROGRAMME: readonly Part[] = [
  {
    title: 'A magnet carries a bead through a maze.',
    link: `${COLON}&goal=-0.24,-0.27&controller=rl${pull(0.19, -0.28, 60)}`,
    speed: 2,
    cues: disturbed('RL: a neural network steers. It sees only the camera picture.', 2, 60),
  },
  {
    title: 'The same maze, with a planner.',
    link: `${COLON}&goal=-0.24,-0.27&controller=errt${pull(0.19, -0.28, 60)}`,
    speed: 2,
    cues: disturbed('ERRT plans a whole path, and plans again at each new wall.', 2, 60),
  },
  {
    title: 'Other obstacles, another controller.',
    link: `#v=1&map=posts&controller=attractor&seed=1&start=-0.25,-0.37&goal=0.24,-0.36${pull(-0.14, -0.5, 24)}`,
    speed: 1,
    cues: disturbed('Attractor dynamics has no plan: the posts in view bend its motion.', 1, 24),
  },
  {
    title: 'The gut moves: waves travel along its walls.',
    link: `${COLON}&goal=-0.24,-0.27&controller=rl&peristalsis_amplitude_m=0.008${pull(0.19, -0.28, 60)}`,
    speed: 2,
    cues: disturbed('The network learned between rigid walls. It looks again at each step.', 2, 60),
  },
  {
    title: 'Your turn: touch the bead and drag it away.',
    link: `${COLON}&goal=-0.19,-0.48&controller=rl`,
    speed: 1,
    cues: [
      {
        when: after(16),
        caption: 'Touch a free place to set another goal.',
        holds: () => true,
      },
      DELIVERED,
    ],
  },
  {
    title: 'A challenge: steer the magnet yourself.',
    cues: [
      {
        when: ({ sim_time_s }) => sim_time_s > GHOSTS_S,
        caption: 'Touch the screen to play.',
        holds: () => true,
      },
    ],
  },
];

/** A caption stays for at least this time, so that it can be read. */
export const READ_MS = 2500;
/** After the last cue the part is shown for this time. */
export const REST_MS = 5000;
/** A part that does not get on, as after a lost connection, is left after this time. */
export const PART_MS = 120_000;
/** Without a touch for this time, the programme begins again. */
export const SILENCE_MS = 60_000;

export interface Place {
  readonly part: number;
  /** Number of cues that have happened or were missed. */
  readonly cues: number;
  /** Whose caption is shown; undefined for the title. */
  readonly shown: Cue | undefined;
  /** The newest cue that has happened, and that waits for the present caption to be read. */
  readonly waiting: Cue | undefined;
  /** When the part and the present caption began. */
  readonly began_ms: number;
  readonly shown_ms: number;
}

export function startOf(part: number, now_ms: number): Place {
  const index = part % PROGRAMME.length;
  const times = { began_ms: now_ms, shown_ms: now_ms };
  return { part: index, cues: 0, shown: undefined, waiting: undefined, ...times };
}

/** The first cue from the next one on that fits the state, and the place after it. */
export function cued(place: Place, state: StateMessage): { cue: Cue; place: Place } | undefined {
  const cues = PROGRAMME[place.part]?.cues ?? [];
  const index = cues.findIndex(({ when }, at) => at >= place.cues && when(state));
  const cue = cues[index];
  if (!cue) return undefined;
  return { cue, place: { ...place, cues: index + 1, waiting: cue } };
}

/** Shows the waiting caption when the present one has had its time, or is true no more. */
export function turned(place: Place, state: StateMessage, now_ms: number): Place {
  const { shown, waiting } = place;
  if (!waiting) return place;
  if ((shown?.holds(state) ?? true) && now_ms - place.shown_ms < READ_MS) return place;
  return { ...place, shown: waiting, waiting: undefined, shown_ms: now_ms };
}

/** The challenge of the programme: the easy one of this day, in UTC as on the server. */
export const challengeOf = (now: Date): string => `easy-${now.toISOString().slice(0, 10)}`;

/** Whether the part has come to its end, or to none. */
export function isOver(place: Place, now_ms: number): boolean {
  const isDone = place.cues === PROGRAMME[place.part]?.cues.length && !place.waiting;
  return (isDone && now_ms - place.shown_ms > REST_MS) || now_ms - place.began_ms > PART_MS;
}

/** Whether a key is that of a visitor, and not one that the screen or the browser is operated with. */
export function isVisitorKey(
  event: Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'altKey' | 'metaKey'>,
): boolean {
  if (event.ctrlKey || event.altKey || event.metaKey) return false;
  return /^(.|Arrow(Left|Right|Up|Down)|Enter|Tab|Home|PageUp|PageDown)$/u.test(event.key);
}

/** The page to return to: that of the session whose path is after `#`, otherwise of the main session. */
export function homeOf(hash: string): string {
  const session = sessionOf({ pathname: hash.slice(1) });
  return addressOf(session === MAIN ? '/' : `/s/${session}`);
}

// The programme of the demonstration: experiments with captions, one after the other. Pure.

import type { ClientMessage, StateMessage } from '../../net/protocol.gen';

/** Something that happens when a state fits: a caption, and maybe a command. */
export interface Cue {
  readonly when: (state: StateMessage) => boolean;
  readonly caption: string;
  readonly command?: ClientMessage;
}

export interface Part {
  readonly title: string;
  /** The hash of an experiment link. */
  readonly link: string;
  readonly speed: number;
  readonly cues: readonly Cue[];
}

const isFetching = ({ mode, phase }: StateMessage): boolean =>
  mode === 1 && phase === 'approaching';
const isCarrying = ({ phase }: StateMessage): boolean => phase === 'transporting';
const isDelivered = ({ deliveries }: StateMessage): boolean => deliveries > 0;
const after =
  (steps: number) =>
  ({ leg_steps }: StateMessage): boolean =>
    leg_steps >= steps;
const pullTo = (x_m: number, y_m: number): ClientMessage => ({
  type: 'disturb',
  disturbance: { displace: { x_m, y_m } },
});

/** The bead is pulled away after some steps of a transport, fetched, and delivered. */
function disturbed(carries: string, steps: number, pull: ClientMessage): readonly Cue[] {
  return [
    { when: after(0.3 * steps), caption: carries },
    { when: after(0.75 * steps), caption: 'Watch: the bead will be pulled away.' },
    { when: after(steps), caption: 'The bead is pulled away.', command: pull },
    { when: isFetching, caption: 'Lost. The arm flies straight to the bead.' },
    { when: isCarrying, caption: 'Fetched. It carries on.' },
    { when: isDelivered, caption: 'Delivered.' },
  ];
}

const COLON = '#v=1&map=colon&seed=1&start=0.19,-0.28';

export const PROGRAMME: readonly Part[] = [
  {
    title: 'A magnet carries a bead through a maze',
    link: `${COLON}&goal=-0.24,-0.27&controller=rl`,
    speed: 2,
    cues: disturbed(
      'A neural network steers. It sees only the camera picture.',
      60,
      pullTo(0.19, -0.28),
    ),
  },
  {
    title: 'The same maze, with a planner',
    link: `${COLON}&goal=-0.24,-0.27&controller=errt`,
    speed: 2,
    cues: disturbed(
      'ERRT plans a path, and plans again at each new wall.',
      60,
      pullTo(0.19, -0.28),
    ),
  },
  {
    title: 'Other obstacles, another controller',
    link: '#v=1&map=posts&controller=attractor&seed=1&start=-0.25,-0.37&goal=0.24,-0.36',
    speed: 1,
    cues: disturbed(
      'Attractor dynamics bends the motion around the posts.',
      24,
      pullTo(-0.14, -0.5),
    ),
  },
  {
    title: 'Your turn: touch the bead and drag it away',
    link: `${COLON}&goal=-0.19,-0.48&controller=rl`,
    speed: 1,
    cues: [
      { when: after(16), caption: 'Touch a free place to set another goal.' },
      { when: isDelivered, caption: 'Delivered.' },
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
  /** Number of cues that have happened. */
  readonly cues: number;
  readonly caption: string;
  /** Captions of cues that have happened, and that wait for the present one to be read. */
  readonly waiting: readonly string[];
  /** When the part and the present caption began. */
  readonly began_ms: number;
  readonly shown_ms: number;
}

export function startOf(part: number, now_ms: number): Place {
  const index = part % PROGRAMME.length;
  const caption = PROGRAMME[index]?.title ?? '';
  return { part: index, cues: 0, caption, waiting: [], began_ms: now_ms, shown_ms: now_ms };
}

/** The next cue, if the state fits it. */
export function nextCue({ part, cues }: Place, state: StateMessage): Cue | undefined {
  const cue = PROGRAMME[part]?.cues[cues];
  return cue?.when(state) ? cue : undefined;
}

export function afterCue(place: Place, { caption }: Cue): Place {
  return { ...place, cues: place.cues + 1, waiting: [...place.waiting, caption] };
}

/** Shows the next waiting caption when the present one has had its time. */
export function turned(place: Place, now_ms: number): Place {
  const [caption, ...waiting] = place.waiting;
  if (caption === undefined || now_ms - place.shown_ms < READ_MS) return place;
  return { ...place, caption, waiting, shown_ms: now_ms };
}

/** Whether the part has come to its end, or to none. */
export function isOver(place: Place, now_ms: number): boolean {
  const isDone = place.cues === PROGRAMME[place.part]?.cues.length && place.waiting.length === 0;
  return (isDone && now_ms - place.shown_ms > REST_MS) || now_ms - place.began_ms > PART_MS;
}

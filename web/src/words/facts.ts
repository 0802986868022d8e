// Phases, reasons, troubles and refusals of a trial as words. Pure.

import type {
  EndFact,
  PhaseFact,
  Reason,
  RecordingFact,
  RefusalFact,
  StopCode,
  TroubleFact,
  VoidFact,
} from '../net/protocol.gen';
import { centimetres, fixed } from '../ui/format';

export const place = (x_m: number, y_m: number): string => `(${fixed(x_m, 3)}, ${fixed(y_m, 3)}) m`;

const PHASES: Readonly<Record<PhaseFact['code'], string>> = {
  holding: 'holding',
  approaching: 'approaching',
  transporting: 'transporting',
  settling: 'settling',
  delivered: 'delivered',
  lifted_off: 'lifted off',
  stopped: 'stopped',
};

/** One or two words. */
export const phaseName = ({ code }: Pick<PhaseFact, 'code'>): string => PHASES[code];

/** What stopped a trial, after a name or `It`. */
const STOPS: Readonly<Record<StopCode, (steps: number) => string>> = {
  leg_steps: (steps) => `${steps} steps without reaching the goal`,
  goal_steps: (steps) => `${steps} steps without delivering`,
  tracker_lost: () => 'the tracker was lost for too long',
  settle: () => 'reached, but the bead did not follow within 5 s',
  walled_off: () => 'the goal is walled off',
};

/** `stopped: 150 steps without reaching the goal`. */
export function phaseWords(phase: PhaseFact): string {
  return phase.code === 'stopped'
    ? `stopped: ${STOPS[phase.by](phase.steps ?? 0)}`
    : phaseName(phase);
}

/** Why a sub-controller is active; with the distance, where nothing beside it shows that. */
export function reasonWords(reason: Reason, hasDistance = false): string {
  if (reason.code === 'lifted_off')
    return 'lift-off: the bead hangs on the magnet; take it off by hand, or reset';
  const far = hasDistance ? `${centimetres(reason.error_m)} away, ` : '';
  if (reason.code === 'wall_between')
    return `fetching${hasDistance ? ': ' : ', '}${far}but a wall is between`;
  const limit = centimetres(reason.threshold_m);
  switch (reason.code) {
    case 'lost':
      return `bead lost: ${far}more than T = ${limit}`;
    case 'fetching':
      return `fetching: ${far}not yet within ${limit}`;
    case 'fetched':
      return `bead fetched: ${far}within ${limit}`;
    case 'held':
      return `bead held: ${far}within T = ${limit}`;
  }
}

const TROUBLES: Readonly<Record<TroubleFact['code'], string>> = {
  saddle: 'is stuck where the flow ends before the goal',
  circling: 'is going to and fro without getting nearer',
  inside_obstacle: 'is too near a wall to go on',
  refused: 'is blocked: each step is refused',
  searching: 'has found no path yet',
  walled_off: 'found no path: the goal is walled off',
  closed: 'is waiting for a closed segment to open',
};

/** What keeps a controller of this name from the goal, as a sentence. */
export const troubleWords = (name: string, { code }: Pick<TroubleFact, 'code'>): string =>
  `${name} ${TROUBLES[code]}.`;

/** Why the arm holds. */
export function holdWords(refusal: RefusalFact): string {
  switch (refusal.code) {
    case 'not_finite':
      return 'the target is not finite';
    case 'outside_workspace':
      return `the target ${place(refusal.x_m, refusal.y_m)} is outside the workspace`;
    case 'out_of_reach': {
      const { distance_m, min_m, max_m } = refusal;
      return `the target is ${fixed(distance_m, 3)} m from the base; the arm reaches ${fixed(min_m, 3)} to ${fixed(max_m, 3)} m at this height`;
    }
    case 'singular':
      return 'the target is too near a singular pose';
    case 'no_inverse':
      return 'no joint angles reach the target';
    case 'too_fast':
      return `the step needs ${fixed(refusal.speed_m_s, 3)} m/s, the limit is ${fixed(refusal.limit_m_s, 3)}`;
    case 'tracker_lost':
      return refusal.is_searching
        ? 'tracker lost; the camera does not show the bead where it was, the arm looks for it'
        : 'tracker lost';
    case 'policy':
      return `no policy: ${refusal.detail}`;
    case 'program':
      return `the program: ${refusal.detail}`;
    case 'searching':
      return `the planner is searching: ${refusal.attempts} edges tried`;
    case 'walled_off':
      return 'the goal is walled off: there is no path, even through places not yet observed';
    case 'closed':
      return 'a segment on the way to the goal is closed: waiting for it to open';
    case 'out_of_view':
      return `the step to ${place(refusal.x_m, refusal.y_m)} leaves the camera’s view`;
    case 'hidden':
      return `the magnet hides the step to ${place(refusal.x_m, refusal.y_m)} from the camera`;
    case 'obstacle':
      return `the camera sees an obstacle on the step, at ${place(refusal.x_m, refusal.y_m)}`;
  }
}

/** Why an attempt at a challenge does not count. */
export const VOIDS: Readonly<Record<VoidFact['code'], string>> = {
  paused: 'it was paused',
  speed: 'another speed was chosen',
  rewound: 'it was rewound',
  other_input: 'something else than the magnet was moved or set',
};

/** Whether the trial is recorded. */
export function recordingWords(fact: RecordingFact): string {
  switch (fact.code) {
    case 'on':
      return 'recording';
    case 'slow':
      return `recording, ${fact.lost_ticks} ticks lost: the disk is too slow`;
    case 'interrupted':
      return `interrupted: ${fact.detail}; waiting for its folder`;
    case 'stopped':
      return `stopped: ${fact.detail}`;
    case 'refused':
      return `not recording: ${fact.detail}`;
    case 'off':
      return 'not recording';
  }
}

const ENDS: Readonly<Record<EndFact['code'], string>> = {
  trial_failed: 'The session has ended',
  crashed: 'The session has ended by a fault of Ferry',
};

/** Why the session ended. */
export const endWords = ({ code, detail }: EndFact): string => `${ENDS[code]}: ${detail}.`;

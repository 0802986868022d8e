// What the demonstration says: a sentence, and a badge that names what acts. Both come from the same state, so that they
// agree with each other and with the trail. Pure.

import type { AttemptStanding, ControllerName, Ghosts, StateMessage } from '../../net/protocol.gen';
import { ghostName } from '../../lab/challenges';
import { seconds } from '../../ui/format';
import { PROGRAMME, type Place } from './programme';

/** What acts: sub-controller 1, or sub-controller 2. */
export interface Badge {
  readonly of: ControllerName | 'fetch';
  readonly text: string;
}

/** Name and kind of each controller, for an audience. */
const CARRIERS: Readonly<Record<ControllerName, readonly [string, string?]>> = {
  rl: ['RL', 'a neural network'],
  errt: ['ERRT', 'a planner'],
  attractor: ['Attractor dynamics'],
  replanner: ['The shortest path'],
  you: ['A visitor'],
  program: ['A program'],
  robot: ['A robot client'],
};

/** Before a visitor points the magnet somewhere, only the ghosts of a challenge move. */
const isGhosts = ({ controller, steer_m }: StateMessage): boolean =>
  controller === 'you' && !steer_m;

export function badgeOf(state: StateMessage, isVisited: boolean): Badge {
  if (state.mode === 1) return { of: 'fetch', text: 'Fetching' };
  const { controller } = state;
  return {
    of: controller,
    text: isGhosts(state) && !isVisited ? 'Ghosts' : CARRIERS[controller].join(', '),
  };
}

/** What happens, in one sentence. */
export function plainSentence(state: StateMessage): string {
  const { mode, phase, goal_m, controller } = state;
  if (mode === 1) return 'The arm flies to the bead.';
  if (phase.code === 'delivered') return 'Delivered.';
  if (isGhosts(state)) return 'Ghosts of earlier attempts race to the goal.';
  const [name] = CARRIERS[controller];
  if (phase.code === 'stopped') return `${name} does not get to the goal.`;
  return goal_m ? `${name} carries the bead to its goal.` : '';
}

/** The sentence of the programme while it is true, otherwise what happens. */
export function programmeSentence({ part, shown }: Place, state: StateMessage): string {
  if (!shown) return PROGRAMME[part]?.title ?? '';
  return shown.holds(state) ? shown.caption : plainSentence(state);
}

/** What a visitor in control reads. */
export function visitorSentence({ hand_m, mode, phase }: StateMessage): string {
  if (hand_m) return 'Pull the bead far away, then let go.';
  if (mode === 1) return 'The bead is lost. The arm flies straight to it.';
  if (phase.code === 'delivered') return 'Delivered. Touch a place to set another goal.';
  return 'You are in control: drag the bead, touch a place to set a goal.';
}

/** Who is to be beaten: the best person, otherwise the fastest controller. */
function rival(ghosts: Ghosts | undefined): { name: string; total_s: number } | undefined {
  const all = (ghosts?.ghosts ?? []).flatMap((ghost) => {
    const { player, total_s } = ghost;
    return total_s === null ? [] : [{ isPerson: player !== null, name: ghostName(ghost), total_s }];
  });
  all.sort((a, b) => Number(b.isPerson) - Number(a.isPerson) || a.total_s - b.total_s);
  return all[0];
}

/** What is shown while the ghosts run and the magnet waits for a visitor. */
export function invitation(ghosts: Ghosts | undefined): string {
  const best = rival(ghosts);
  const word = best ? `${best.name} needs ${seconds(best.total_s)}. ` : '';
  return `${word}Touch the screen and be faster.`;
}

/** What a visitor reads who plays the challenge. */
export function playedSentence(attempt: AttemptStanding, ghosts: Ghosts | undefined): string {
  const again = 'Touch the screen to try again.';
  if (attempt.is_time_up) return `Time is up. ${again}`;
  if (!attempt.is_delivered) {
    return `Roll the bead into the green circle: ${seconds(attempt.total_s)}`;
  }
  const best = rival(ghosts);
  const own = `Delivered: ${seconds(attempt.total_s)}.`;
  if (!best) return `${own} ${again}`;
  return attempt.total_s < best.total_s
    ? `${own} You are faster than ${best.name}!`
    : `${own} ${best.name} needs ${seconds(best.total_s)}. ${again}`;
}

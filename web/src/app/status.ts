// What happens now, as one sentence and one number. Pure.

import { isOver } from '../lab/contest';
import type { ConnectionState } from '../lab/model';
import { controllerLabel } from '../lab/parameters';
import type { AttemptStanding, EndFact, StateMessage } from '../net/protocol.gen';
import { capital, centimetres, seconds } from '../ui/format';
import type { Controller } from '../ui/controllers';
import { endWords, holdWords, phaseWords, troubleWords } from '../words/facts';

export interface Status {
  readonly text: string;
  /** For a phone, where there is no room. */
  readonly short?: string;
  /** One number. */
  readonly more?: string | undefined;
  readonly tone: 'plain' | 'good' | 'bad';
  /** Whose shape stands before the sentence. */
  readonly controller?: Controller;
}

/** What the sentence says beside the state. */
export interface Around {
  readonly isStuck: boolean;
  /** A finger taps, a mouse clicks. */
  readonly isTouch: boolean;
  /** Whether a press of this browser sets goals. */
  readonly setsGoals: boolean;
  /** How long the delivery took. */
  readonly delivery_s: number | undefined;
}

const plain = (text: string, rest: Partial<Status> = {}): Status => ({
  text,
  tone: 'plain',
  ...rest,
});
const bad = (text: string, rest: Partial<Status> = {}): Status => ({ text, tone: 'bad', ...rest });

function connectionStatus(connection: ConnectionState): Status | undefined {
  switch (connection.kind) {
    case 'connecting':
      return plain('Connecting to the server');
    case 'live':
      return undefined;
    case 'lost':
      return bad('No connection: reconnecting', { more: `attempt ${connection.attempt}` });
    case 'outdated':
      return bad('The server has another version: reload the page');
  }
}

const pressWord = (isTouch: boolean): string => (isTouch ? 'Tap' : 'Click');
const noGoalStatus = ({ isTouch }: Around, controller: Controller): Status =>
  plain(`${pressWord(isTouch)} the map to set a goal`, {
    controller,
    short: `${pressWord(isTouch)} to set a goal`,
  });

/** What is next after a delivery. */
function deliveredStatus(controller: Controller, around: Around): Status {
  const { isTouch, setsGoals, delivery_s } = around;
  const text = delivery_s === undefined ? 'Delivered' : `Delivered in ${seconds(delivery_s)}`;
  const press = pressWord(isTouch);
  return {
    tone: 'good',
    controller,
    ...(setsGoals
      ? {
          text: `${text}. ${press} the map to set the next goal`,
          short: `Delivered. ${press} a goal`,
        }
      : { text }),
  };
}

function runningStatus(state: StateMessage, around: Around): Status {
  const { controller, phase, refusal, trouble } = state;
  const name = controllerLabel({ controller, program: state.program?.name ?? null });
  const whose = { controller };
  const more =
    state.goal_distance_m === null
      ? undefined
      : `${centimetres(state.goal_distance_m)} to the goal`;
  if (controller === 'robot') return plain('A robot client moves the arm', whose);
  if (trouble) {
    const words = troubleWords(name, trouble).replace(/\.$/, '');
    return bad(words, { ...whose, short: `${name} cannot go on` });
  }
  switch (phase.code) {
    case 'holding':
      if (refusal) return bad(capital(holdWords(refusal)), { ...whose, short: 'The arm holds' });
      return state.goal_m ? plain('The arm holds', whose) : noGoalStatus(around, controller);
    case 'approaching':
      return plain('The arm fetches the bead', {
        ...whose,
        more: `${centimetres(state.tracked_error_m)} away`,
      });
    case 'transporting':
      if (around.isStuck) return bad(`${name} is stuck`, { ...whose, more });
      return controller === 'you'
        ? plain('You carry the bead', { ...whose, more })
        : plain(`${name} carries the bead to the goal`, {
            ...whose,
            short: `${name} carries`,
            more,
          });
    case 'settling':
      return plain('The bead comes to rest at the goal', { ...whose, short: 'The bead settles' });
    case 'delivered':
      return deliveredStatus(controller, around);
    case 'lifted_off':
      return bad('The bead hangs on the magnet', whose);
    case 'stopped':
      return bad(capital(phaseWords(phase)), { ...whose, short: 'Stopped' });
  }
}

export function statusOf(
  connection: ConnectionState,
  ended: EndFact | undefined,
  state: StateMessage | undefined,
  around: Around,
): Status {
  if (ended) return bad(endWords(ended).replace(/\.$/, ''), { short: 'The session has ended' });
  const trouble = connectionStatus(connection);
  if (trouble) return trouble;
  if (!state) return plain('Waiting for the first state');
  if (state.attempt && isOver(state.attempt)) return attemptStatus(state.attempt);
  const { phase, running } = state;
  if (
    running ||
    phase.code === 'delivered' ||
    phase.code === 'stopped' ||
    phase.code === 'lifted_off'
  )
    return runningStatus(state, around);
  const { controller } = state;
  if (state.tick > 0) return plain('Paused', { controller });
  return state.goal_m || controller === 'you' || controller === 'robot'
    ? plain('Ready to run', { controller })
    : noGoalStatus(around, controller);
}

function attemptStatus(attempt: AttemptStanding): Status {
  return attempt.is_delivered
    ? { text: 'Delivered: the attempt is over', tone: 'good', short: 'Delivered' }
    : bad('The attempt is over');
}

// Why a goal was not reached, in plain words, and what can help. Pure.

import { phaseWords, troubleWords } from '../words/facts';
import { CONTROLLER_LABELS } from './parameters';
import type {
  ControllerName,
  EventMessage,
  MomentMessage,
  PhaseFact,
  SceneMessage,
  StateMessage,
  TroubleFact,
} from '../net/protocol.gen';

export interface Attempt {
  readonly controller: ControllerName;
  /** The phase that ended it. */
  readonly end: PhaseFact;
  /** What kept the controller from the goal. */
  readonly trouble: TroubleFact | null;
  readonly map: string;
  /** Maps that the policy was trained on; undefined if they are unknown. */
  readonly trainedOn?: readonly string[] | undefined;
}

/** An attempt as it was when its end came: the controller may be changed afterwards. */
export interface Failed extends Attempt {
  /** Trial, goal, steps and end: it distinguishes one end from the next. */
  readonly key: string;
}

/** Whether a phase ends an attempt without a delivery. */
export const isFailure = ({ code }: Pick<PhaseFact, 'code'>): boolean =>
  code === 'lifted_off' || code === 'stopped';

/** The failed attempt of a state; undefined if none has failed. `before` is that of the last state. */
export function failedAttempt(
  before: Failed | undefined,
  state: Pick<StateMessage, 'phase' | 'goal_m' | 'steps' | 'controller' | 'trouble'>,
  { map, trial }: Pick<SceneMessage, 'map' | 'trial'>,
  trainedOn: Attempt['trainedOn'],
): Failed | undefined {
  const { phase: end, goal_m, steps, controller, trouble } = state;
  // While paused, the phase stays after the goal was removed.
  if (!isFailure(end) || (!goal_m && end.code !== 'lifted_off')) return undefined;
  const key = [trial, goal_m?.join(), steps, phaseWords(end)].join(' ');
  if (before?.key !== key) return { key, controller, end, trouble, map, trainedOn };
  // On a new page the policy comes after the state.
  return { ...before, trainedOn: before.trainedOn ?? trainedOn };
}

/** Whether the policy was used on a map that it never saw. */
function isForeign({ controller, map, trainedOn }: Attempt): boolean {
  return controller === 'rl' && trainedOn !== undefined && !trainedOn.includes(map);
}

/** What stopped an attempt, other than the number of its steps, and what the operator can do in the workspace. */
const STOPS = {
  settle: {
    cause: () => 'The tool reached the goal, but the bead did not follow within 5 s.',
    advice: 'Choose another goal, or drag the bead to this one.',
  },
  walled_off: {
    cause: (name: string) => troubleWords(name, { code: 'walled_off' }),
    advice: 'Choose another goal.',
  },
  tracker_lost: {
    cause: () => 'The tracker was lost for too long.',
    advice: 'Choose another goal when the tracker reports the bead again.',
  },
  leg_steps: undefined,
  goal_steps: undefined,
} as const;

/** The cause in one to three sentences. */
export function causeOf(attempt: Attempt): string {
  const { controller, end, trouble } = attempt;
  const name = CONTROLLER_LABELS[controller];
  if (end.code !== 'stopped') return 'The magnet lifted the bead off the table.';
  // What troubled the controller before is over.
  const stop = STOPS[end.by];
  if (stop) return stop.cause(name);
  const sentences =
    trouble === null
      ? [`${name} ${phaseWords(end)}.`]
      : [troubleWords(name, trouble), `It ${phaseWords(end)}.`];
  if (isForeign(attempt)) sentences.push('It was not trained on this map.');
  return sentences.join(' ');
}

/** The cause of an event that ended an attempt without a delivery. */
export function causeOfEvent(
  { what }: Pick<EventMessage, 'what'>,
  { controller, trouble, overlay }: Pick<MomentMessage, 'controller' | 'trouble' | 'overlay'>,
  map: string,
): string | undefined {
  const lifted = { code: 'lifted_off' } as const;
  const end =
    what.code === 'stopped' ? what.phase : what.code === 'lifted_off' ? lifted : undefined;
  const trainedOn = overlay.judgement?.trained_on;
  return end && causeOf({ controller, end, trouble, map, trainedOn });
}

/** Number of control steps that the same goal gives when it is set again; undefined if they cannot help. */
export const furtherSteps = ({ end }: Attempt): number | undefined =>
  end.code === 'stopped' ? end.steps : undefined;

/** Another controller to try, if there is a better one. */
export function betterController(attempt: Attempt): ControllerName | undefined {
  return furtherSteps(attempt) === undefined || attempt.controller === 'errt' ? undefined : 'errt';
}

/** Whether only a reset can help. */
export const needsReset = ({ end }: Attempt): boolean => end.code === 'lifted_off';

/** What the operator can do where no button can help. */
export const adviceOf = ({ end }: Attempt): string | undefined =>
  end.code === 'stopped' ? STOPS[end.by]?.advice : undefined;

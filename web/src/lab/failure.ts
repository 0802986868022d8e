// Why a goal was not reached, in plain words, and what can help. Pure.

import { CONTROLLER_LABELS } from './parameters';
import type {
  ControllerName,
  EventMessage,
  MomentMessage,
  SceneMessage,
  StateMessage,
} from '../net/protocol.gen';

export interface Attempt {
  readonly controller: ControllerName;
  /** The phase or the outcome, such as `stopped: 150 steps without reaching the goal`. */
  readonly end: string;
  /** What kept the controller from the goal. */
  readonly trouble: string | null;
  readonly map: string;
  /** Maps that the policy was trained on; undefined if they are unknown. */
  readonly trainedOn?: readonly string[] | undefined;
}

/** An attempt as it was when its end came: the controller may be changed afterwards. */
export interface Failed extends Attempt {
  /** Trial, goal, steps and end: it distinguishes one end from the next. */
  readonly key: string;
}

const LIFTED_OFF = 'lifted off';
const REACHED = 'stopped: reached';
const TRACKER_LOST = 'stopped: the tracker was lost for too long';
const WALLED_OFF = 'stopped: the goal is walled off';
const STEP_LIMIT = /^stopped: (\d+) steps/;

/** Whether a phase ends an attempt without a delivery. */
export function isFailure(phase: string): boolean {
  return phase === LIFTED_OFF || phase.startsWith('stopped');
}

/** The failed attempt of a state; undefined if none has failed. `before` is that of the last state. */
export function failedAttempt(
  before: Failed | undefined,
  state: Pick<StateMessage, 'phase' | 'goal_m' | 'steps' | 'controller' | 'trouble'>,
  { map, trial }: Pick<SceneMessage, 'map' | 'trial'>,
  trainedOn: Attempt['trainedOn'],
): Failed | undefined {
  const { phase: end, goal_m, steps, controller, trouble } = state;
  // While paused, the phase stays after the goal was removed.
  if (!isFailure(end) || (!goal_m && end !== LIFTED_OFF)) return undefined;
  const key = [trial, goal_m?.join(), steps, end].join(' ');
  if (before?.key !== key) return { key, controller, end, trouble, map, trainedOn };
  // On a new page the policy comes after the state.
  return { ...before, trainedOn: before.trainedOn ?? trainedOn };
}

/** Whether the policy was used on a map that it never saw. */
function isForeign({ controller, map, trainedOn }: Attempt): boolean {
  return controller === 'rl' && trainedOn !== undefined && !trainedOn.includes(map);
}

/** What keeps a controller from the goal, as a sentence. */
export function troubleWords(name: string, trouble: string): string {
  if (trouble === 'no path found yet') return `${name} has found no path yet.`;
  if (trouble === 'walled off') return `${name} found no path: the goal is walled off.`;
  return `${name} is ${trouble}.`;
}

/** The cause in one to three sentences. */
export function causeOf(attempt: Attempt): string {
  const { controller, end, trouble } = attempt;
  const name = CONTROLLER_LABELS[controller];
  if (end === LIFTED_OFF) return 'The magnet lifted the bead off the table.';
  // What troubled the controller before is over.
  if (end.startsWith(REACHED)) return `${end.replace(REACHED, 'The tool reached the goal')}.`;
  if (end === WALLED_OFF) return troubleWords(name, 'walled off');
  if (end === TRACKER_LOST) return 'The tracker was lost for too long.';
  const sentences =
    trouble === null ? [`${name} ${end}.`] : [troubleWords(name, trouble), `It ${end}.`];
  if (isForeign(attempt)) sentences.push('It was not trained on this map.');
  return sentences.join(' ');
}

/** The cause of an event that ended an attempt without a delivery. */
export function causeOfEvent(
  { kind, text }: Pick<EventMessage, 'kind' | 'text'>,
  { controller, trouble, overlay }: Pick<MomentMessage, 'controller' | 'trouble' | 'overlay'>,
  map: string,
): string | undefined {
  if (kind !== 'stopped' && kind !== 'lift_off') return undefined;
  const end = kind === 'stopped' ? text : LIFTED_OFF;
  return causeOf({ controller, end, trouble, map, trainedOn: overlay.judgement?.trained_on });
}

/** Number of control steps that the same goal gives when it is set again; undefined if they cannot help. */
export function furtherSteps({ end }: Attempt): number | undefined {
  const steps = STEP_LIMIT.exec(end)?.[1];
  return steps === undefined ? undefined : Number(steps);
}

/** Another controller to try, if there is a better one. */
export function betterController(attempt: Attempt): ControllerName | undefined {
  return furtherSteps(attempt) === undefined || attempt.controller === 'errt' ? undefined : 'errt';
}

/** Whether only a reset can help. */
export const needsReset = ({ end }: Attempt): boolean => end === LIFTED_OFF;

/** What the operator can do in the workspace, where no button can help. */
export function adviceOf({ end }: Attempt): string | undefined {
  if (end.startsWith(REACHED)) return 'Choose another goal, or drag the bead to this one.';
  if (end === TRACKER_LOST) return 'Choose another goal when the tracker reports the bead again.';
  return end === WALLED_OFF ? 'Choose another goal.' : undefined;
}

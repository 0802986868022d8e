// Why a goal was not reached, in plain words. Pure.

import { CONTROLLER_LABELS } from './parameters';
import type { ControllerName, EventMessage, MomentMessage } from '../net/protocol.gen';

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

export const LIFTED_OFF = 'lifted off';

/** Whether a phase ends an attempt without a delivery. */
export function isFailure(phase: string): boolean {
  return phase === LIFTED_OFF || phase.startsWith('stopped');
}

/** Whether the policy was used on a map that it never saw. */
function isForeign({ controller, map, trainedOn }: Attempt): boolean {
  return controller === 'rl' && trainedOn !== undefined && !trainedOn.includes(map);
}

/** The cause in one or two sentences. */
export function causeOf(attempt: Attempt): string {
  const { controller, end, trouble } = attempt;
  if (end === LIFTED_OFF) return 'The magnet lifted the bead off the table.';
  const name = CONTROLLER_LABELS[controller];
  const sentences = [
    trouble === null ? `${name}: ${end.replace(/^stopped: /, '')}.` : `${name} is ${trouble}.`,
  ];
  if (trouble !== null) sentences.push(`It ${end}.`);
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

/** Another controller to try, if there is a better one. */
export function betterController({ controller, end }: Attempt): ControllerName | undefined {
  // A wall is a wall for each controller.
  return end === LIFTED_OFF || end.includes('walled off') || controller === 'errt'
    ? undefined
    : 'errt';
}

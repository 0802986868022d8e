// The story of an event: error against threshold, and the inputs of the active sub-controller. Pure.

import { ACTIONS } from './actions';
import { centimetres, clock, counted, fixed, millimetres } from '../ui/format';
import { holdWords, place } from '../words/facts';
import { CONTROLLER_LABELS } from './parameters';
import type { EventKind, EventMessage, MomentMessage } from '../net/protocol.gen';
import { distance } from './geometry';

const TITLES: Readonly<Record<EventKind, string>> = {
  switch: 'Switch',
  disturbance: 'Disturbance',
  goal: 'Goal',
  reached: 'Reached',
  delivered: 'Delivered',
  lift_off: 'Lift-off',
  refused: 'Refused',
  stopped: 'Stopped',
  session: 'Session',
};

/** Kinds of events with a mark on the timeline, the most important first. Other kinds have no mark. */
export const MARKED_KINDS: readonly EventKind[] = [
  'lift_off',
  'stopped',
  'switch',
  'disturbance',
  'delivered',
  'refused',
  'goal',
  'reached',
];

/** Whether two messages are about the same event: the server sends events again. */
export const isSameEvent = (a: EventMessage, b: EventMessage): boolean =>
  a.tick === b.tick && a.kind === b.kind && JSON.stringify(a.what) === JSON.stringify(b.what);

export function eventTitle(event: Pick<EventMessage, 'kind' | 'sim_time_s'>): string {
  return `${TITLES[event.kind]} at ${clock(event.sim_time_s)}`;
}

/** The text with a capital letter and a full stop. */
export function sentence(text: string): string {
  const trimmed = text.trim();
  const end = /[.!?]$/.test(trimmed) ? '' : '.';
  return trimmed.charAt(0).toUpperCase() + trimmed.slice(1) + end;
}

/** How far the error is from the threshold. */
export function marginWords({ error_m, threshold_m }: MomentMessage): string {
  const over_m = error_m - threshold_m;
  return `${centimetres(Math.abs(over_m))} ${over_m > 0 ? 'over' : 'within'} the limit`;
}

function transport(moment: MomentMessage): string {
  const { overlay, controller } = moment;
  const name = CONTROLLER_LABELS[controller];
  switch (controller) {
    case 'attractor': {
      const count = overlay.obstacles.length;
      return `${name} sensed ${counted(count, 'obstacle')} in the image.`;
    }
    case 'errt': {
      const corners = overlay.plan?.way.length ?? 0;
      return corners > 0
        ? `${name} followed a path of ${corners} points around the obstacles seen so far.`
        : `${name} had no path yet.`;
    }
    case 'replanner':
      return `${name} followed the shortest path around the obstacles seen so far.`;
    case 'you':
      return overlay.target_m
        ? `Your hand led the tool to ${place(...overlay.target_m)}.`
        : 'Your hand did not move the tool.';
    case 'program':
      return overlay.target_m
        ? `The program sent the tool to ${place(...overlay.target_m)}.`
        : 'The program did not move the tool.';
    case 'robot':
      return 'A robot client commanded the joints.';
    case 'rl': {
      const judged = overlay.judgement;
      const action = judged && ACTIONS[judged.taken];
      if (!judged || !action) return `${name} had not used an image yet.`;
      return `${name} chose ${action.arrow} ${action.name} with a value of ${fixed(judged.values[judged.taken] ?? 0, 2)} (expected return)${judged.is_shortcut ? ', and went straight over the next cells' : ''}.`;
    }
  }
}

/** The inputs of the active sub-controller as sentences. */
export function whatItSaw(moment: MomentMessage): string {
  const tracker = millimetres(distance(moment.bead_tracked_m, moment.bead_m), 1);
  const bead = `The tracker reported the bead at ${place(...moment.bead_tracked_m)}, ${tracker} from its true position.`;
  const parts = [bead];
  if (moment.mode === 1) {
    parts.push('Sub-controller 1 flies to the bead and does not use the camera.');
  } else if (!moment.goal_m) {
    parts.push('No goal is set, so sub-controller 2 does not move the arm.');
  } else {
    const left = centimetres(distance(moment.tool_m, moment.goal_m));
    parts.push(transport(moment), `The goal was ${left} away.`);
  }
  if (moment.refusal !== null)
    parts.push(`The arm did not move: ${sentence(holdWords(moment.refusal))}`);
  return parts.join(' ');
}

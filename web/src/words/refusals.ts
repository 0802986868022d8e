// Why a command was refused, as a sentence from its code, field and values. Pure.

import type { RefusalCode, RefusedMessage } from '../net/protocol.gen';
import { fixed } from '../ui/format';
import { CONTROLLER_LABELS } from '../net/protocol.gen';

type Refused = Omit<RefusedMessage, 'id'>;

const NAMES: Readonly<Record<string, string>> = CONTROLLER_LABELS;
const text = (value: unknown): string =>
  typeof value === 'number' || typeof value === 'string' ? String(value) : 'missing';
const number = (value: unknown): string => (typeof value === 'number' ? fixed(value, 3) : '–');
const spot = ({ values: { x_m, y_m } }: Refused): string => `(${number(x_m)}, ${number(y_m)}) m`;
const what = ({ field }: Refused): string => field ?? 'The command';
const range = (one: Refused): string =>
  `${what(one)} is ${text(one.values.value)}, it must be ${text(one.values.allowed)}.`;
const controller = ({ values }: Refused): string => NAMES[text(values.controller)] ?? 'another one';
/** What is wrong inside a file or in a robot, which only the server can say. */
const inside = ({ detail }: Refused): string => detail;

const SENTENCES: Readonly<Record<RefusalCode, (one: Refused) => string>> = {
  malformed: inside,
  not_operator: () => 'Another browser has control. Take control first.',
  kept: ({ values }) => `The operator keeps control. Ask again in ${text(values.wait_s)} s.`,
  stale_epoch: () => 'Another browser took control meanwhile.',
  out_of_range: range,
  not_finite: (one) => `${what(one)} must be a finite number.`,
  long_reason: () => 'The program’s reason is too long.',
  outside_workspace: (one) => `${spot(one)} is outside the workspace.`,
  // A goal is where the user has pressed.
  in_wall: (one) =>
    one.field === 'goal'
      ? 'A wall is there.'
      : `${spot(one)} is in a wall, or nearer to one than the bead’s radius of 2.5 mm.`,
  out_of_reach: (one) => (one.field === 'goal' ? 'The arm cannot go there.' : inside(one)),
  parameter_out_of_range: range,
  disturbance_out_of_range: range,
  not_you: (one) => `Only the controller You can be steered; it is ${controller(one)}.`,
  not_robot: (one) =>
    `Only a robot client commands the joints; the controller is ${controller(one)}.`,
  not_program: (one) => `Only a program is asked; the controller is ${controller(one)}.`,
  joints_refused: inside,
  hand_silent: () =>
    'The server received nothing from the hand for a time: it released the bead and paused.',
  too_many_wait: () => 'Too many inputs wait for the next tick. Run the session first.',
  map_refused: inside,
  unknown_policy: inside,
  bad_script: inside,
  trial_failed: inside,
  bad_case: inside,
  other_drawing: (one) =>
    `This server has another drawing named ${text(one.values.name)}. Give the map in the file another name.`,
  no_challenge: () => 'No challenge is being played in this session.',
  no_run: (one) => `Run ${text(one.values.run)} is no longer kept.`,
  nothing_carried: () =>
    'Nothing was carried yet, so the case would expect nothing. Run the session first.',
  forgotten: () =>
    'The start of the trial is no longer kept. Reset, and save a case within ten minutes.',
  no_program: (one) => `No program named ${text(one.values.program)} has connected.`,
  no_try: () => 'The recovery map no longer has this trial.',
  no_training: (one) => `There is no training named ${text(one.values.training)}.`,
  no_goal: () => 'No goal was set at that moment, so there is nothing to compare.',
  no_robot: () => 'This session drives no robot.',
  robot_refused: inside,
  busy: () => 'The session is busy: too many commands wait.',
  unanswered: () => 'The session has not answered in time. The command may still be carried out.',
  ended: () => 'The session has ended.',
};

export const refusalWords = (refused: Refused): string => SENTENCES[refused.code](refused);

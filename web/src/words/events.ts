// Events as sentences. Pure.

import type { Happening, Resumption } from '../net/protocol.gen';
import { CONTROLLER_LABELS } from '../net/protocol.gen';
import { centimetres, fixed } from '../ui/format';
import { holdWords, phaseWords, place, reasonWords } from './facts';

const RESUMED: Readonly<Record<Resumption, string>> = {
  goes_on: 'the session goes on from its last saved state',
  started_over: 'the session started over',
  started_over_with_runs: 'the session started over; what was saved is kept as runs',
};

const whole_cm = (distance_m: number): string => `${fixed(100 * distance_m, 0)} cm`;

/** What has happened, without a capital letter and a full stop. */
export function eventWords(what: Happening): string {
  switch (what.code) {
    case 'took_over':
      return `sub-controller ${what.sub_controller} takes over: ${reasonWords(what.reason, true)}`;
    case 'taken':
      return 'disturbed: bead taken by hand';
    case 'placed':
      return `disturbed: bead moved ${whole_cm(what.distance_m)} by hand`;
    case 'released':
      return 'bead released';
    case 'displaced':
      return `disturbed: the bead was lifted ${whole_cm(what.distance_m)} away`;
    case 'kicked':
      return `disturbed: a kick of ${fixed(1000 * what.impulse_n_s, 2)} mN·s`;
    case 'pushed':
      return `disturbed: a push of ${fixed(1000 * what.force_n, 1)} mN for ${what.for_s} s`;
    case 'blinded':
      return `disturbed: the tracker is blind for ${what.for_s} s`;
    case 'not_disturbed':
      return 'no disturbance: no free place is far enough from the bead';
    case 'goal_placed':
      return `goal placed at ${place(what.x_m, what.y_m)}`;
    case 'goal_removed':
      return 'goal removed';
    case 'reached':
      return 'reached: the tool is within 2 cm of the goal';
    case 'delivered':
      return `delivered: bead within ${centimetres(what.distance_m)} of the goal`;
    case 'lifted_off':
      return 'lift-off: the bead jumped to the magnet';
    case 'step_refused':
      return `${what.is_holding ? 'the arm holds: ' : ''}${holdWords(what.refusal)}`;
    case 'tracker_back':
      return 'the tracker reports the bead again';
    case 'stopped':
      return phaseWords(what.phase);
    case 'controller_selected':
      return `controller: ${CONTROLLER_LABELS[what.controller]}`;
    case 'set_up': {
      const { map, seed, inputs } = what;
      const opened = inputs === undefined ? '' : `, test case with ${inputs} inputs`;
      return `set up: map ${map}, seed ${seed}${opened}`;
    }
    case 'took_up':
      return `set up: ${what.about}`;
    case 'returned':
      return `returned to run ${what.run}`;
    case 'inputs_left_out':
      return `test case: ${what.count} inputs at this tick were left out; the last one because ${what.detail}`;
    case 'resumed':
      return what.lost === undefined ? RESUMED[what.how] : `${RESUMED[what.how]}; ${what.lost}`;
    case 'robot':
      return `${what.is_client ? 'robot client' : 'robot'}: ${what.detail}`;
  }
}

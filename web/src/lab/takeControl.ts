import type { Notices, Session } from './slices';

/** Takes control; where another browser operates, it is asked to release it. */
export function takeControl(lab: Session & Notices): void {
  lab.send({ type: 'take_control' });
  if (lab.hello()?.operator_present) {
    lab.notify('session', 'Asked: the operator has to release control.');
  }
}

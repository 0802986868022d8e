import type { Notices, Session } from './slices';

/** Takes control. If another browser is the operator, it receives the request to release control. */
export function takeControl(lab: Session & Notices): void {
  lab.send({ type: 'take_control' });
  if (lab.hello()?.operator_present) {
    lab.notify('session', 'Request sent. Waiting for the operator.');
  }
}

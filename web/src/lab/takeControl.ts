import type { Notices, Session } from './slices';

/** Takes control. If another browser is the operator, it receives the request to release control. */
export async function takeControl(lab: Session & Notices): Promise<void> {
  const answer = await lab.send('session', { type: 'take_control' });
  if (answer.kind === 'done' && lab.hello()?.role !== 'operator') {
    lab.notify('session', 'Request sent. Waiting for the operator.');
  }
}

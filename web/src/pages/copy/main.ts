// The page of a shared experiment, lesson or challenge. A link from another site may not open a session, so the user
// presses a button here.

import { belowSession } from '../../lab/copyLink';
import { openOwn } from '../../lab/ownSession';
import { reasonText } from '../../net/problem';
import { theme } from '../../ui/theme';
import { part } from '../part';

theme();
const button = part('button');
const refusal = part('p', '[role=alert]');
button.onclick = () => {
  button.disabled = true;
  openOwn(belowSession(window.location)).catch((reason: unknown) => {
    refusal.textContent = reasonText(reason);
    button.disabled = false;
  });
};

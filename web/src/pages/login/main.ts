// The login page. It sends the token to the server once, in a request body, and stores it nowhere.

import { reasonText } from '../../net/problem';
import { answered } from '../../net/requests';
import { theme } from '../../ui/theme';
import { takeToken } from '../../net/loginToken';
import { part } from '../part';
import { addressOf, pathOf } from '../../net/base';

const form = part('form');
const field = part('input', '#token');
const button = part('button');
const status = part('p', '[role=status]');

theme();

function say(text: string, isRefusal = false): void {
  status.textContent = text;
  field.setAttribute('aria-invalid', String(isRefusal));
}

async function logIn(token: string): Promise<void> {
  button.disabled = true;
  say('Logging in…');
  try {
    await answered('/login', {
      method: 'POST',
      headers: { 'content-type': 'application/json' },
      body: JSON.stringify({ token }),
    });
    enter();
  } catch (reason) {
    say(reasonText(reason), true);
    button.disabled = false;
    field.focus();
    field.select();
  }
}

form.addEventListener('submit', (event) => {
  event.preventDefault();
  void logIn(field.value.trim());
});

/** Loads the requested page after the login. */
function enter(): void {
  if (pathOf(window.location.pathname) === '/login') window.location.replace(addressOf('/'));
  else window.location.reload();
}

/** A link from another site comes without the cookie, although the browser may have it. */
function isKnown(): Promise<boolean> {
  return answered('/api/maps', { method: 'HEAD' }).then(
    () => true,
    () => false,
  );
}

async function begin(carried: string | undefined): Promise<void> {
  if (await isKnown()) enter();
  else if (carried !== undefined) await logIn(carried);
}

field.focus();
void begin(takeToken(window));
// A pasted link that differs only in the token does not load the page, so read the token here.
window.addEventListener('hashchange', () => {
  const token = takeToken(window);
  if (token !== undefined) void logIn(token);
});

// Whether the login is still valid. A login can expire; the next request shows it.

import { createSignal } from 'solid-js';
import { problemOf } from './problem';
import { addressOf } from './base';

const NO_LOGIN = 401;
const [loggedOut, setLoggedOut] = createSignal(false);

/** The server requires the token again. */
export { loggedOut };

/** Requests a page again. The server opens its session if it does not exist. */
export async function openPage(
  path: string,
): Promise<{ readonly isOpen: boolean; readonly why?: string | undefined }> {
  const response = await askServer(path, { cache: 'no-store' }).catch(() => undefined);
  if (response?.ok) return { isOpen: true };
  return { isOpen: false, why: response && (await problemOf(response)).detail };
}

/** `fetch` for all requests of the page to its server. */
export async function askServer(path: string, init?: RequestInit): Promise<Response> {
  const response = await fetch(addressOf(path), init);
  setLoggedOut(response.status === NO_LOGIN);
  return response;
}

// Whether the login is still valid. A login can expire; the next request shows it.

import { createSignal } from 'solid-js';
import { problemText } from './problem';
import { addressOf } from './base';

const NO_LOGIN = 401;
const [loggedOut, setLoggedOut] = createSignal(false);

/** The server requires the token again. */
export { loggedOut };

/** Requests a page again. The server opens its session if it does not exist. */
export async function openPage(
  path: string,
): Promise<{ readonly isOpen: boolean; readonly why?: string | undefined }> {
  try {
    const response = await askServer(path, { cache: 'no-store' });
    if (response.ok) return { isOpen: true };
    const problem: unknown = await response.json();
    return { isOpen: false, why: problemText(problem) };
  } catch {
    // No connection, or the answer is not a problem document: show the login.
    return { isOpen: false };
  }
}

/** `fetch` for all requests of the page to its server. */
export async function askServer(path: string, init?: RequestInit): Promise<Response> {
  const response = await fetch(addressOf(path), init);
  setLoggedOut(response.status === NO_LOGIN);
  return response;
}

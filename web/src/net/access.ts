// Whether the server still accepts this page: a login ends, and the next request is refused.

import { createSignal } from 'solid-js';
import { problemText } from './problem';

const NO_LOGIN = 401;
const [loggedOut, setLoggedOut] = createSignal(false);

/** The server wants the token shown again. */
export { loggedOut };

/** Requests the page again, which creates its session if it does not exist. */
export async function openPage(
  path: string,
): Promise<{ readonly isOpen: boolean; readonly why?: string | undefined }> {
  try {
    const response = await askServer(path, { cache: 'no-store' });
    if (response.ok) return { isOpen: true };
    const problem: unknown = await response.json();
    return { isOpen: false, why: problemText(problem) };
  } catch {
    // Gone, or what it says is no problem: the page to log in.
    return { isOpen: false };
  }
}

/** `fetch` for all that the page asks its server. */
export async function askServer(path: string, init?: RequestInit): Promise<Response> {
  const response = await fetch(path, init);
  setLoggedOut(response.status === NO_LOGIN);
  return response;
}

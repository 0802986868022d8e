// The session of a page, from its address.

import { pathOf } from './base';

/** The session that always exists. */
export const MAIN = 'main';

const DEMO = 'demo';

/** Whether the address is that of the demonstration. */
export function isDemo({ pathname }: Pick<Location, 'pathname'>): boolean {
  return pathOf(pathname) === '/demo';
}

/** Whether the address is that of a board. It needs no session. */
export function isBoard({ pathname }: Pick<Location, 'pathname'>): boolean {
  return pathOf(pathname) === '/board';
}

/** `/s/anna` is the page of the session `anna`, `/demo` of `demo`; every other address belongs to `main`. */
export function sessionOf(page: Pick<Location, 'pathname'>): string {
  if (isDemo(page)) return DEMO;
  return /^\/s\/([a-z0-9-]{1,32})(?:\/[a-z0-9/-]*)?$/.exec(pathOf(page.pathname))?.[1] ?? MAIN;
}

/** Path of a session's resource on the server. */
export function sessionPath(session: string, what: string): string {
  return `/api/sessions/${encodeURIComponent(session)}/${what}`;
}

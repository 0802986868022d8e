// Which session a page is about: its address says.

/** The session that is always there. */
export const MAIN = 'main';

/** `/s/anna` is the page of the session `anna`, every other address that of `main`. */
export function sessionOf({ pathname }: Pick<Location, 'pathname'>): string {
  return /^\/s\/([a-z0-9-]{1,32})$/.exec(pathname)?.[1] ?? MAIN;
}

/** Where the server has something of a session. */
export function sessionPath(session: string, what: string): string {
  return `/api/sessions/${encodeURIComponent(session)}/${what}`;
}

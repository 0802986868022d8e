// The session of a page, from its address.

/** The session that always exists. */
export const MAIN = 'main';

/** `/s/anna` is the page of the session `anna`; every other address belongs to `main`. */
export function sessionOf({ pathname }: Pick<Location, 'pathname'>): string {
  return /^\/s\/([a-z0-9-]{1,32})$/.exec(pathname)?.[1] ?? MAIN;
}

/** Path of a session's resource on the server. */
export function sessionPath(session: string, what: string): string {
  return `/api/sessions/${encodeURIComponent(session)}/${what}`;
}

// A link may contain the token after `#`. Browsers do not send this part to a server.

interface Page {
  readonly location: Pick<Location, 'hash' | 'pathname' | 'search'>;
  readonly history: Pick<History, 'replaceState'>;
}

const CARRIED = '#token=';

export const carriesToken = (page: Page): boolean => page.location.hash.startsWith(CARRIED);

/** Returns the token in the page's address and removes it from the address and the history. */
export function takeToken(page: Page): string | undefined {
  const { hash, pathname, search } = page.location;
  if (!carriesToken(page)) return undefined;
  const carried = hash.slice(CARRIED.length);
  const end = carried.indexOf('&');
  const rest = end < 0 ? '' : `#${carried.slice(end + 1)}`;
  page.history.replaceState(null, '', `${pathname}${search}${rest}`);
  return end < 0 ? carried : carried.slice(0, end);
}

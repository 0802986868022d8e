// A link may carry the token after its `#`, which browsers send to nobody.

interface Page {
  readonly location: Pick<Location, 'hash' | 'pathname' | 'search'>;
  readonly history: Pick<History, 'replaceState'>;
}

const CARRIED = '#token=';

export function carriesToken(page: Page): boolean {
  return page.location.hash.startsWith(CARRIED);
}

/** The token that the page's address carries, which is taken out of it and of the history. */
export function takeToken(page: Page): string | undefined {
  const { hash, pathname, search } = page.location;
  if (!carriesToken(page)) return undefined;
  const carried = hash.slice(CARRIED.length);
  const end = carried.indexOf('&');
  const rest = end < 0 ? '' : `#${carried.slice(end + 1)}`;
  page.history.replaceState(null, '', `${pathname}${search}${rest}`);
  return end < 0 ? carried : carried.slice(0, end);
}

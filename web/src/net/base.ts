// Where the addresses of the server begin: `/`, or behind a proxy a path such as `/ferry/`.

/** Built scripts are in `assets/`. */
const BASE = import.meta.env.PROD ? new URL('..', import.meta.url).pathname : '/';

/** The address of what the server has at a path such as `/api/maps`. */
export const addressOf = (path: string, base = BASE): string => base + path.slice(1);

/** The reverse of `addressOf`. */
export const pathOf = (address: string, base = BASE): string =>
  address.startsWith(base) ? `/${address.slice(base.length)}` : address;

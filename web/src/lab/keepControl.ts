// What a page keeps over a reload or a lost connection: the key of its seat, with which the server gives it control again,
// and whether it had control.

import type { Hello } from '../net/protocol.gen';

const KEY = 'ferry.operates';
const SEAT_KEY = 'ferry.seat';
/** The server knows the page again within this time. */
const RETURN_MS = 10_000;

/** `tab` is the storage of the browser's tab. */
export function createKeeper(
  session: string,
  tab: Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>,
) {
  let isOperator = false;
  let until_ms = 0;
  return {
    /** Whether the connection is new and control that this page had before may come back, or just has. */
    isReturning: (): boolean => Date.now() < until_ms,
    /** Key of the seat that this page had before. */
    seat: () => tab.getItem(SEAT_KEY) ?? undefined,
    opened: () => {
      isOperator = false;
      until_ms = tab.getItem(KEY) === session ? Date.now() + RETURN_MS : 0;
    },
    hello: ({ role, seat }: Pick<Hello, 'role' | 'seat'>) => {
      tab.setItem(SEAT_KEY, seat);
      if (role === 'operator') {
        isOperator = true;
        tab.setItem(KEY, session);
      } else if (isOperator) {
        // Released, or passed to another browser.
        isOperator = false;
        until_ms = 0;
        tab.removeItem(KEY);
      }
    },
  };
}

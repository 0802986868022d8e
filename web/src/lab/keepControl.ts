// What a page keeps over a reload or a lost connection: the key of its seat, and control. The server may close the old
// connection after the new one has come. Then control is free, and the page that had it takes it again.

import type { Hello } from '../net/protocol.gen';

const KEY = 'ferry.operates';
const SEAT_KEY = 'ferry.seat';
/** The old connection is closed within this time. */
const RETAKE_MS = 10_000;

/** `tab` is the storage of the browser's tab. */
export function createKeeper(
  session: string,
  tab: Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>,
  take: () => void,
) {
  let isOperator = false;
  let hasAsked = false;
  let until_ms = 0;
  const isReturning = (): boolean => Date.now() < until_ms;
  return {
    /** Whether the connection is new and control that this page had before may come back, or just has. */
    isReturning,
    /** Key of the seat that this page had before. */
    seat: () => tab.getItem(SEAT_KEY) ?? undefined,
    opened: () => {
      isOperator = false;
      hasAsked = false;
      until_ms = tab.getItem(KEY) === session ? Date.now() + RETAKE_MS : 0;
    },
    hello: ({
      role,
      operator_present,
      seat,
    }: Pick<Hello, 'role' | 'operator_present' | 'seat'>) => {
      tab.setItem(SEAT_KEY, seat);
      if (role === 'operator') {
        isOperator = true;
        tab.setItem(KEY, session);
      } else if (isOperator) {
        // Released, or passed to another browser.
        isOperator = false;
        until_ms = 0;
        tab.removeItem(KEY);
      } else if (!operator_present && !hasAsked && isReturning()) {
        hasAsked = true;
        take();
      }
    },
  };
}

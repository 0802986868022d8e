// The connection: opens the WebSocket, reconnects, and passes received messages on.

import type { ClientMessage, ServerMessage } from './protocol.gen';
import { sessionPath } from './session';
import { addressOf } from './base';

const HEADER_BYTES = 8;

export interface Picture {
  readonly kind: number;
  readonly tick: number;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

export interface Listener {
  opened(): void;
  /** The connection was lost or could not be opened. `attempt` counts from 1 since the last open connection. */
  lost(attempt: number): void;
  /** The server refuses to open the session again; with the reason. */
  refused(why: string): void;
  message(message: ServerMessage): void;
  picture(picture: Picture): void;
}

/** A message with the id of its answer. */
export type Numbered = ClientMessage & { readonly id?: number };

/** `seat` is the key that the server gave this browser before. */
export function liveAddress(
  { protocol, host }: Pick<Location, 'protocol' | 'host'>,
  session: string,
  seat?: string,
): string {
  const scheme = protocol === 'https:' ? 'wss:' : 'ws:';
  const query = seat === undefined ? '' : `?${new URLSearchParams({ seat }).toString()}`;
  return `${scheme}//${host}${addressOf(sessionPath(session, 'live') + query)}`;
}

/** The address of the WebSocket, and what to do before a new attempt. */
export interface Line {
  address(): string;
  /** The session has ended: do not reconnect. */
  isOver(): boolean;
  /** Requests the session again, which may be missing after a restart of the server. Returns the reason for a refusal. */
  reopen(): Promise<{ readonly isOpen: boolean; readonly why?: string | undefined }>;
}

/** Doubles from half a second to eight seconds. `chance` in [0, 1) makes many browsers reconnect at different times. */
export function backoffMs(attempt: number, chance: number): number {
  const full = Math.min(8000, 500 * 2 ** (attempt - 1));
  return full * (0.75 + 0.5 * chance);
}

/** The format is described in `server/protocol.rs`. */
export function readPicture(frame: ArrayBuffer): Picture | undefined {
  if (frame.byteLength < HEADER_BYTES) return undefined;
  const head = new DataView(frame);
  return {
    kind: head.getUint8(0),
    tick: head.getUint32(4, true),
    bytes: new Uint8Array(frame, HEADER_BYTES),
  };
}

export function connect(line: Line, listener: Listener) {
  let socket: WebSocket | undefined;
  let attempt = 0;
  /** Epoch of this browser's lease, as the server sent it last on this connection. */
  let epoch: number | undefined;

  const lose = (): void => {
    attempt += 1;
    listener.lost(attempt);
    setTimeout(() => void openAgain(), backoffMs(attempt, Math.random()));
  };
  const openAgain = async (): Promise<void> => {
    if (line.isOver()) return;
    const { isOpen, why } = await line.reopen();
    if (why !== undefined) listener.refused(why);
    if (isOpen) open();
    else lose();
  };
  const open = (): void => {
    const next = new WebSocket(line.address());
    next.binaryType = 'arraybuffer';
    next.onopen = () => {
      attempt = 0;
      socket = next;
      listener.opened();
    };
    next.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (typeof event.data === 'string') {
        const message = JSON.parse(event.data) as ServerMessage;
        if (message.type === 'hello') epoch = message.epoch;
        listener.message(message);
        return;
      }
      const picture = readPicture(event.data);
      if (picture) listener.picture(picture);
    };
    // An error is always followed by a close.
    next.onclose = () => {
      socket = undefined;
      epoch = undefined;
      lose();
    };
  };
  open();

  return {
    /** Returns whether the message was sent. */
    send(message: Numbered): boolean {
      if (socket?.readyState !== WebSocket.OPEN) return false;
      // Without an epoch, the text has none.
      socket.send(JSON.stringify({ ...message, epoch }));
      return true;
    },
  };
}

// The socket: opens it, opens it again when it is lost, and tells what it hears.

import type { ClientMessage, ServerMessage } from './protocol.gen';
import { sessionPath } from './session';

const HEADER_BYTES = 8;

export interface Picture {
  readonly kind: number;
  readonly tick: number;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

export interface Listener {
  opened(): void;
  /** Lost, or never opened; `attempt` counts from 1 since it was last open. */
  lost(attempt: number): void;
  /** The server does not open the session again, and says why. */
  refused(why: string): void;
  message(message: ServerMessage): void;
  picture(picture: Picture): void;
}

export interface Connection {
  /** Whether it went out. */
  send(message: ClientMessage): boolean;
}

/** Address of a session's socket, on the host that served the page. */
export function liveAddress(page: { protocol: string; host: string }, session: string): string {
  const scheme = page.protocol === 'https:' ? 'wss:' : 'ws:';
  return `${scheme}//${page.host}${sessionPath(session, 'live')}`;
}

/** Where the socket is, and what is to be done before it is opened again. */
export interface Line {
  readonly address: string;
  /** Nothing more is to be expected at its other end. */
  isOver(): boolean;
  /** Asks for the session again, which may have gone with its server; why not, if the server says so. */
  reopen(): Promise<{ readonly isOpen: boolean; readonly why?: string | undefined }>;
}

type Sent = ClientMessage & { readonly epoch?: number };

/** Doubles from half a second to eight; `chance` in [0, 1) spreads many browsers out. */
export function backoffMs(attempt: number, chance: number): number {
  const full = Math.min(8000, 500 * 2 ** (attempt - 1));
  return full * (0.75 + 0.5 * chance);
}

/** See the head of `server/protocol.rs`. */
export function readPicture(frame: ArrayBuffer): Picture | undefined {
  if (frame.byteLength < HEADER_BYTES) return undefined;
  const head = new DataView(frame);
  return {
    kind: head.getUint8(0),
    tick: head.getUint32(4, true),
    bytes: new Uint8Array(frame, HEADER_BYTES),
  };
}

export function connect(line: Line, listener: Listener): Connection {
  let socket: WebSocket | undefined;
  let attempt = 0;
  /** Under which lease this browser acts: as the server said last on this socket. */
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
    const next = new WebSocket(line.address);
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
    send(message) {
      if (socket?.readyState !== WebSocket.OPEN) return false;
      const sent: Sent = epoch === undefined ? message : { ...message, epoch };
      socket.send(JSON.stringify(sent));
      return true;
    },
  };
}

// The socket: opens it, opens it again when it is lost, and tells what it hears.

import type { ClientMessage, ServerMessage } from './protocol.gen';

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
  return `${scheme}//${page.host}/api/sessions/${encodeURIComponent(session)}/live`;
}

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

export function connect(address: string, listener: Listener): Connection {
  let socket: WebSocket | undefined;
  let attempt = 0;

  const open = (): void => {
    const next = new WebSocket(address);
    next.binaryType = 'arraybuffer';
    next.onopen = () => {
      attempt = 0;
      socket = next;
      listener.opened();
    };
    next.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (typeof event.data === 'string') {
        listener.message(JSON.parse(event.data) as ServerMessage);
        return;
      }
      const picture = readPicture(event.data);
      if (picture) listener.picture(picture);
    };
    // An error is always followed by a close.
    next.onclose = () => {
      socket = undefined;
      attempt += 1;
      listener.lost(attempt);
      setTimeout(open, backoffMs(attempt, Math.random()));
    };
  };
  open();

  return {
    send(message) {
      if (socket?.readyState !== WebSocket.OPEN) return false;
      socket.send(JSON.stringify(message));
      return true;
    },
  };
}

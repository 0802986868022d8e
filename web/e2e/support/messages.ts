// Records the WebSocket messages of a page.

import type { Page, WebSocket } from '@playwright/test';
import { must } from './wait';
import type {
  CatalogMessage,
  ClientMessage,
  ComparisonMessage,
  EventMessage,
  Hello,
  OverlayMessage,
  SceneMessage,
  SeenMessage,
  ServerMessage,
  StateMessage,
} from './wire';

/** The last message of each type that the page sent. */
type Sent = { [T in ClientMessage['type']]?: Extract<ClientMessage, { type: T }> };

/** The messages of a page's WebSocket in both directions. */
export class Messages {
  sent: Sent & Record<string, ClientMessage | undefined> = {};
  readonly events: EventMessage[] = [];
  overlay: OverlayMessage | undefined;
  comparison: ComparisonMessage | undefined;
  /** The newest items of each list of the server. */
  readonly lists: {
    -readonly [N in CatalogMessage['list']]?: Extract<CatalogMessage, { list: N }>['items'];
  } = {};
  private lastSeen: SeenMessage | undefined;
  private lastHello: Hello | undefined;
  private lastScene: SceneMessage | undefined;
  private lastState: StateMessage | undefined;

  constructor(page: Page) {
    page.on('websocket', (socket) => {
      this.listen(socket);
    });
  }

  get hello() {
    return must(this.lastHello, 'the message hello');
  }

  get scene() {
    return must(this.lastScene, 'the message scene');
  }

  /** The obstacle map, with the state of each cell, row by row. */
  get obstacles() {
    const seen = must(this.lastSeen, 'the message seen');
    return {
      ...seen,
      cells: seen.runs.flatMap(([state, count]) => Array<number>(count).fill(state)),
    };
  }

  get state() {
    return must(this.lastState, 'the message state');
  }

  /** Whether the page has received a state and a scene. */
  get isComplete() {
    return this.lastState !== undefined && this.lastScene !== undefined;
  }

  private listen(socket: WebSocket) {
    socket.on('framesent', ({ payload }) => {
      const message = JSON.parse(String(payload)) as ClientMessage;
      this.sent[message.type] = message as never;
      if (message.type === 'fork') this.comparison = undefined;
    });
    socket.on('framereceived', ({ payload }) => {
      if (typeof payload === 'string') this.store(JSON.parse(payload) as ServerMessage);
    });
  }

  private store(message: ServerMessage) {
    switch (message.type) {
      case 'hello':
        this.lastHello = message;
        break;
      case 'scene':
        this.lastScene = message;
        break;
      case 'state':
        this.lastState = message;
        break;
      case 'overlay':
        this.overlay = message;
        break;
      case 'seen':
        this.lastSeen = message;
        break;
      case 'comparison':
        this.comparison = message;
        break;
      case 'catalog':
        Object.assign(this.lists, { [message.list]: message.items });
        break;
      case 'event':
        this.events.push(message);
        break;
      default:
    }
  }
}

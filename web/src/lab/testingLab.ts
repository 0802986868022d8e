// The laboratory of a component test: the page's own code, with a server that the test plays.

import '../styles/tokens.css';
import '../styles/reset.css';
import '../ui/buttons.css';
import '../ui/controls.css';
import '../ui/text.css';
import { createRoot, type JSX } from 'solid-js';
import { render } from 'solid-js/web';
import { afterEach, vi } from 'vitest';
import {
  type CatalogMessage,
  type ClientMessage,
  type Hello,
  PROTOCOL_VERSION,
  type RefusalCode,
  type SceneMessage,
  type ServerMessage,
  type StateMessage,
} from '../net/protocol.gen';
import type { Numbered } from '../net/connection';
import { createLab } from './lab';
import type { KnownLayer } from './layers';
import type { Lab } from './slices';
import { sceneOf, stateAt } from './testing';

/** An answer is JSON, or a `Response`. */
export type Answers = Record<string, (body: string, path: string) => unknown>;

const HELLO: Hello = {
  protocol: PROTOCOL_VERSION,
  message_bytes: 65536,
  session: 'main',
  seat: 'a1',
  version: '0',
  role: 'operator',
  epoch: 1,
  operator_present: true,
  asked: false,
  asks: false,
  ahead: 0,
  answer_within_s: null,
  adapter: '',
  opened: '',
  resumed_s: null,
};

type Lists = { readonly [M in CatalogMessage as M['list']]?: M['items'] };

/** What the server answers when it refuses a request. */
export function refusal(detail: string, field?: string): Response {
  return Response.json({ detail, field }, { status: 422 });
}

/** Plays the server of one test. */
export class FakeServer {
  /** Commands of the page, oldest first. */
  readonly sent: Numbered[] = [];
  private readonly open: number[] = [];
  /** Requests of the page, such as `GET /api/recordings`, oldest first. */
  readonly requests: string[] = [];
  private scenes = sceneOf('posts');
  private states = stateAt(0, { running: false });
  private listed: Lists = {
    maps: ['posts'],
    policies: [],
    trainings: [],
    evaluations: [],
    recoveries: [],
    programs: [],
    challenges: [],
    jobs: [],
    paces: [],
  };
  private socket: FakeSocket | undefined;

  /** `answers` by method and path, without the query. A request that is not in it waits forever. */
  constructor(private readonly answers: Answers = {}) {}

  /** The newest command of this type. */
  command<T extends ClientMessage['type']>(
    type: T,
  ): Extract<ClientMessage, { type: T }> | undefined {
    const is = (one: ClientMessage): one is Extract<ClientMessage, { type: T }> =>
      one.type === type;
    return this.sent.filter(is).at(-1);
  }

  tell(...messages: ServerMessage[]): void {
    for (const message of messages) this.socket?.onmessage({ data: JSON.stringify(message) });
  }
  hello(change: Partial<Hello> = {}): void {
    this.tell({ type: 'hello', ...HELLO, ...change });
  }
  /** The newest scene with a change. */
  scene(change: Partial<SceneMessage> = {}): void {
    this.scenes = { ...this.scenes, ...change };
    this.tell({ type: 'scene', ...this.scenes });
  }
  /** The newest state with a change. */
  state(change: Partial<StateMessage> = {}): void {
    this.states = { ...this.states, ...change };
    this.tell({ type: 'state', ...this.states });
  }
  /** The lists that are named have these items now. */
  lists(change: Lists): void {
    this.listed = { ...this.listed, ...change };
    for (const [list, items] of Object.entries(change))
      this.tell({ type: 'catalog', list, items } as ServerMessage);
  }
  /** Carries out the newest `load_scenario`. */
  load(): void {
    const { scenario: before, trial, defaults } = this.scenes;
    const sent = this.command('load_scenario');
    if (!sent) throw new Error('no scenario was loaded');
    const { map, controller = before.controller, parameters = defaults, script = [] } = sent;
    const { start_m = null, goal_m = null, disturbances = 0, positioner = null } = sent;
    const seed = Number(sent.seed ?? before.seed);
    const rest = { seed, parameters, script, start_m, goal_m, disturbances, positioner };
    const scenario = { ...before, map, controller, ...rest };
    this.scene({ map, seed, parameters, scenario, trial: trial + 1 });
    this.state({ tick: 0, newest_tick: 0, controller, goal_m: goal_m && [...goal_m, 0] });
    this.done();
  }
  /** Says that all open commands were carried out. */
  done(): void {
    const { trial } = this.scenes;
    for (const id of this.open.splice(0)) this.tell({ type: 'done', id, trial });
  }
  /** Refuses the newest open command. */
  refuse(code: RefusalCode, detail: string): void {
    const id = this.open.pop();
    if (id === undefined) throw new Error('no command is open');
    this.tell({ type: 'refused', id, code, values: {}, detail });
  }
  receive(message: Numbered): void {
    this.sent.push(message);
    if (message.id !== undefined) this.open.push(message.id);
  }

  opened(socket: FakeSocket): void {
    this.socket = socket;
    this.hello();
    this.scene();
    this.state();
    this.lists(this.listed);
  }
  disconnect(): void {
    const { socket } = this;
    this.socket = undefined;
    socket?.close();
  }
  async answer(request: string, path: string, body: string): Promise<Response> {
    this.requests.push(request);
    const answer = this.answers[request];
    if (!answer) return new Promise(() => undefined);
    const content = await answer(body, path);
    return content instanceof Response ? content : Response.json(content);
  }
}

/** The address of the tests, which show other views. */
const START = location.href;

let server = new FakeServer();
let end: (() => void)[] = [];

/** A socket that opens at once if the server is connected. */
class FakeSocket {
  static readonly OPEN = WebSocket.OPEN;
  readyState = 0;
  binaryType = 'blob';
  onopen = (): void => undefined;
  onmessage: (event: { data: string }) => void = () => undefined;
  onclose = (): void => undefined;

  constructor() {
    queueMicrotask(() => {
      this.readyState = FakeSocket.OPEN;
      this.onopen();
      server.opened(this);
    });
  }
  send(text: string): void {
    server.receive(JSON.parse(text) as Numbered);
  }
  close(): void {
    this.readyState = WebSocket.CLOSED;
    this.onclose();
  }
}

vi.stubGlobal('WebSocket', FakeSocket);
vi.stubGlobal('fetch', (path: string, init: RequestInit = {}) => {
  const [plain] = path.split('?');
  const body = typeof init.body === 'string' ? init.body : '';
  return server.answer(`${init.method ?? 'GET'} ${plain ?? ''}`, path, body);
});

afterEach(() => {
  for (const dispose of end) dispose();
  end = [];
  document.body.replaceChildren();
  localStorage.clear();
  sessionStorage.clear();
  history.replaceState(null, '', START);
});

/** The server that the next laboratory connects to. */
export function fakeServer(answers?: Answers): FakeServer {
  server = new FakeServer(answers);
  return server;
}

/** Shows a component until the test ends. */
export function show(component: () => JSX.Element): void {
  const root = document.createElement('div');
  root.id = 'app';
  document.body.append(root);
  end.push(render(component, root));
}

/** A laboratory and its server. */
export function fakeLab(
  answers?: Answers,
  layers: readonly KnownLayer[] = [],
): { lab: Lab; server: FakeServer } {
  const played = fakeServer(answers);
  const lab = createRoot((dispose) => {
    end.push(dispose);
    return createLab(window, layers);
  });
  return { lab, server: played };
}

import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { backoffMs, connect, type Line, liveAddress, readPicture } from './connection';

describe('the address of the WebSocket', () => {
  it('is on the host that served the page', () => {
    expect(liveAddress({ protocol: 'http:', host: '127.0.0.1:8080' }, 'main')).toBe(
      'ws://127.0.0.1:8080/api/sessions/main/live',
    );
    expect(liveAddress({ protocol: 'https:', host: 'lab' }, 'main', 'a1')).toMatch(
      /^wss:.*live.seat=a1$/,
    );
  });
});

describe('the pause before another attempt', () => {
  it('grows from half a second to eight seconds, and is random', () => {
    expect(backoffMs(1, 0.5)).toBe(500);
    expect(backoffMs(3, 0.5)).toBe(2000);
    expect(backoffMs(50, 0.5)).toBe(8000);
    expect(backoffMs(1, 0)).toBeLessThan(backoffMs(1, 0.99));
  });
});

describe('a binary frame', () => {
  it('is read as kind, tick and payload', () => {
    const frame = new Uint8Array([2, 0, 0, 0, 1, 2, 0, 0, 7, 8]).buffer;
    const picture = readPicture(frame);
    expect(picture?.kind).toBe(2);
    expect(picture?.tick).toBe(513);
    expect([...(picture?.bytes ?? [])]).toEqual([7, 8]);
  });

  it('is dropped if it is too short', () => {
    expect(readPicture(new ArrayBuffer(7))).toBeUndefined();
  });
});

/** A fake WebSocket. The test is its server. */
class FakeSocket {
  static readonly OPEN = 1;
  static readonly all: FakeSocket[] = [];
  readonly readyState = FakeSocket.OPEN;
  readonly sent: unknown[] = [];
  onopen?: () => void;
  onmessage?: (event: { data: string }) => void;
  onclose?: () => void;

  constructor(readonly address: string) {
    FakeSocket.all.push(this);
  }

  send(text: string): void {
    this.sent.push(JSON.parse(text));
  }

  receive(message: object): void {
    this.onmessage?.({ data: JSON.stringify(message) });
  }
}

describe('a connection', () => {
  const calls: string[] = [];
  const open = (line: Partial<Line> = {}): ReturnType<typeof connect> =>
    connect(
      {
        address: () => 'ws://lab/live',
        isOver: () => false,
        reopen: () => Promise.resolve({ isOpen: true }),
        ...line,
      },
      {
        opened: () => calls.push('opened'),
        lost: (attempt) => calls.push(`lost ${attempt}`),
        refused: (why) => calls.push(why),
        message: ({ type }) => calls.push(type),
        picture: () => undefined,
      },
    );
  const socket = (): FakeSocket => {
    const last = FakeSocket.all.at(-1);
    if (!last) throw new Error('no socket was opened');
    return last;
  };
  beforeEach(() => {
    vi.useFakeTimers();
    vi.stubGlobal('WebSocket', FakeSocket);
    FakeSocket.all.length = 0;
    calls.length = 0;
  });
  afterEach(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });

  it('uses the epoch that the server sent last on this connection', async () => {
    const connection = open();
    socket().onopen?.();
    connection.send({ type: 'pause' });
    socket().receive({ type: 'hello', epoch: 3 });
    socket().receive({ type: 'hello', epoch: 5 });
    connection.send({ type: 'run' });
    expect(socket().sent).toEqual([{ type: 'pause' }, { type: 'run', epoch: 5 }]);

    socket().onclose?.();
    expect(connection.send({ type: 'run' })).toBe(false);
    await vi.advanceTimersByTimeAsync(1000);
    socket().onopen?.();
    connection.send({ type: 'run' });
    expect(socket().sent).toEqual([{ type: 'run' }]);
  });

  it('requests its session before each new attempt, and reports a refusal', async () => {
    const answers = [{ isOpen: false, why: 'no room' }, { isOpen: false }, { isOpen: true }];
    const reopen = vi.fn(() => Promise.resolve(answers.shift() ?? { isOpen: true }));
    open({ reopen });
    socket().onopen?.();
    expect(reopen).not.toHaveBeenCalled();
    socket().onclose?.();
    await vi.advanceTimersByTimeAsync(20_000);
    expect(reopen).toHaveBeenCalledTimes(3);
    expect(FakeSocket.all).toHaveLength(2);
    expect(calls).toEqual(['opened', 'lost 1', 'no room', 'lost 2', 'lost 3']);
  });

  it('stays closed when its session has ended', async () => {
    open({ isOver: () => true });
    socket().onclose?.();
    await vi.advanceTimersByTimeAsync(60_000);
    expect(FakeSocket.all).toHaveLength(1);
  });
});

import { createRoot, createSignal } from 'solid-js';
import { expect, it, vi } from 'vitest';
import type { Lumen } from '../net/protocol.gen';
import type { ConnectionState } from './model';
import { lumenOf, sceneOf, stateAt } from './testing';
import { createWalls } from './walls';

const ROOM = [
  [0, 0],
  [0.4, 0],
  [0.4, 0.2],
  [0, 0.2],
] as const;
const LIVE: ConnectionState = { kind: 'live' };
const REST = stateAt(0);
const moving = (tick: number) => stateAt(tick, { wave_m: [0.001 * tick, 0.001 * tick] });
const settled = () => new Promise((done) => setTimeout(done));

function open(answer: (path: string) => Promise<Lumen>) {
  const [connection, setConnection] = createSignal<ConnectionState>(LIVE);
  const [scene, setScene] = createSignal(sceneOf('colon'));
  const [state, setState] = createSignal(REST);
  const notify = vi.fn();
  const request = vi.fn(answer);
  const walls = createRoot(() =>
    createWalls({ session: 'anna', connection, scene, state, notify }, request),
  );
  return { walls, request, notify, setConnection, setScene, setState };
}

it('asks for the outline when the walls move, once for each map', async () => {
  let map = 'colon';
  const { walls, request, setScene, setState } = open(() =>
    Promise.resolve({ ...lumenOf([ROOM]), map }),
  );
  expect(request).not.toHaveBeenCalled();
  setState(moving(1));
  expect(request.mock.calls).toEqual([['/api/sessions/anna/lumen']]);
  expect(walls()).toBeUndefined();
  await settled();
  const first = walls();
  expect(first?.covers([0.2, 0.0005])).toBe(true);
  expect(first?.covers([0.2, 0.0015])).toBe(false);
  setState(moving(2));
  expect(walls()).toBe(first);
  expect(first?.covers([0.2, 0.0015])).toBe(true);
  setState(REST);
  expect(walls()).toBeUndefined();
  setState(moving(3));
  await settled();
  expect(request).toHaveBeenCalledTimes(1);
  map = 'posts';
  setScene(sceneOf('posts', 1));
  expect(walls()).toBeUndefined();
  await settled();
  expect(request).toHaveBeenCalledTimes(2);
  expect(walls()?.map).toBe('posts');
});

it('reports a failed request, and repeats it only when the walls begin to move again', async () => {
  const { walls, request, notify, setConnection, setState } = open(() =>
    Promise.reject(new Error('The server did not answer.')),
  );
  for (const tick of [1, 2, 3]) {
    setState(moving(tick));
    await settled();
  }
  expect(request).toHaveBeenCalledTimes(1);
  expect(notify.mock.calls).toEqual([
    ['workspace', 'The moving walls cannot be drawn: The server did not answer.'],
  ]);
  expect(walls()).toBeUndefined();
  setConnection({ kind: 'lost', attempt: 1 });
  setConnection(LIVE);
  await settled();
  expect(request).toHaveBeenCalledTimes(2);
  setState(REST);
  setState(moving(5));
  await settled();
  expect(request).toHaveBeenCalledTimes(3);
});

it('drops the answer to a request of an earlier map', async () => {
  const answers: ((lumen: Lumen) => void)[] = [];
  const { walls, setScene, setState } = open(() => new Promise((done) => answers.push(done)));
  setState(moving(1));
  setScene(sceneOf('posts', 1));
  answers[1]?.({ ...lumenOf([ROOM]), map: 'posts' });
  await settled();
  answers[0]?.({ ...lumenOf([ROOM]), map: 'colon' });
  await settled();
  expect(walls()?.map).toBe('posts');
});

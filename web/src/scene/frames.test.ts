import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Frames } from './frames';

let waiting: ((now_ms: number) => void)[] = [];
let now_ms = 1000;

beforeEach(() => {
  waiting = [];
  vi.stubGlobal('requestAnimationFrame', (callback: (now_ms: number) => void) =>
    waiting.push(callback),
  );
  vi.stubGlobal('cancelAnimationFrame', () => {
    waiting = [];
  });
});
afterEach(() => {
  vi.unstubAllGlobals();
});

function pass(frames: number): void {
  for (let i = 0; i < frames; i++) {
    now_ms += 16;
    for (const callback of waiting.splice(0)) callback(now_ms);
  }
}

test('no frame is drawn at rest, and one for all changes before it', () => {
  const drawn: number[] = [];
  const frames = new Frames((elapsed_ms) => {
    drawn.push(elapsed_ms);
    return false;
  });
  pass(50);
  expect(drawn).toEqual([]);
  frames.request();
  frames.request();
  pass(50);
  expect(drawn).toEqual([0]);
});

test('frames go on while something moves, and know the time between them', () => {
  const drawn: number[] = [];
  const frames = new Frames((elapsed_ms) => drawn.push(elapsed_ms) < 4);
  frames.request();
  pass(50);
  expect(drawn).toEqual([0, 16, 16, 16]);
  // After a rest, the time of the rest does not count.
  frames.request();
  pass(50);
  expect(drawn).toEqual([0, 16, 16, 16, 0]);
  frames.request();
  frames.stop();
  pass(50);
  expect(drawn).toHaveLength(5);
});

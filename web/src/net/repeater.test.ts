import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { Repeater } from './repeater';

beforeEach(() => {
  vi.useFakeTimers({ now: 0 });
});
afterEach(() => {
  vi.useRealTimers();
});

it('repeats the newest value at every interval until it stops', () => {
  const said: [string, number][] = [];
  const repeater = new Repeater<string>(500, (value) => said.push([value, Date.now()]));
  repeater.say('a');
  vi.advanceTimersByTime(400);
  repeater.say('b');
  vi.advanceTimersByTime(1200);
  repeater.stop();
  vi.advanceTimersByTime(5000);
  expect(said).toEqual([
    ['a', 0],
    ['b', 400],
    ['b', 900],
    ['b', 1400],
  ]);
});

it('repeats a new value after a stop', () => {
  const said: string[] = [];
  const repeater = new Repeater<string>(500, (value) => said.push(value));
  repeater.say('a');
  repeater.stop();
  repeater.say('b');
  vi.advanceTimersByTime(1000);
  expect(said).toEqual(['a', 'b', 'b', 'b']);
});

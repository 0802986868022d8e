import { expect, it } from 'vitest';
import { Repeater } from './repeater';
import { manualClock } from './testing';

it('repeats the newest value at every interval until it stops', () => {
  const clock = manualClock();
  const said: [string, number][] = [];
  const repeater = new Repeater<string>(500, (value) => said.push([value, clock.nowMs()]), clock);
  repeater.say('a');
  clock.advance(400);
  repeater.say('b');
  clock.advance(1200);
  repeater.stop();
  clock.advance(5000);
  expect(said).toEqual([
    ['a', 0],
    ['b', 400],
    ['b', 900],
    ['b', 1400],
  ]);
});

it('repeats a new value after a stop', () => {
  const clock = manualClock();
  const said: string[] = [];
  const repeater = new Repeater<string>(500, (value) => said.push(value), clock);
  repeater.say('a');
  repeater.stop();
  repeater.say('b');
  clock.advance(1000);
  expect(said).toEqual(['a', 'b', 'b', 'b']);
});

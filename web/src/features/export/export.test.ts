import { expect, it } from 'vitest';
import { stateAt } from '../../lab/testing';
import { caption, fileName } from './picture';
import { videoEnding, videoType } from './video';

const GOAL: [number, number, number] = [0.1, -0.3, 0];
const at = (change: Parameters<typeof stateAt>[1]) =>
  stateAt(1537, { controller: 'rl', goal_m: GOAL, ...change });

it('names a file by map, controller and time of the trial', () => {
  expect(fileName('colon', at({}), 'png')).toBe('ferry-colon-rl-12.3s.png');
  expect(fileName('map-1', stateAt(0), 'webm')).toBe('ferry-map-1-attractor-0.0s.webm');
});

it.each([
  [{ phase: 'transporting' }, 'colon · RL · t = 12.3 s · goal not reached'],
  [{ phase: 'settling' }, 'colon · RL · t = 12.3 s · goal reached'],
  [{ phase: 'delivered' }, 'colon · RL · t = 12.3 s · delivered'],
  [{ phase: 'holding', goal_m: null }, 'colon · RL · t = 12.3 s · no goal'],
])('the caption of %j', (change, words) => {
  expect(caption('colon', at(change))).toBe(words);
});

it.each([
  ['everything', () => true, 'video/webm;codecs=vp8', 'webm'],
  ['VP9 only', (type: string) => type.includes('vp9'), 'video/webm;codecs=vp9', 'webm'],
  ['WebM by its own codec', (type: string) => type === 'video/webm', 'video/webm', 'webm'],
  ['MP4 only', (type: string) => type.startsWith('video/mp4'), 'video/mp4', 'mp4'],
] as const)('records a type that the browser supports: %s', (_, isTypeSupported, type, ending) => {
  const chosen = videoType({ isTypeSupported });
  expect(chosen).toBe(type);
  expect(videoEnding(chosen ?? '')).toBe(ending);
});

it('records nothing without a recorder or a known type', () => {
  expect(videoType(undefined)).toBeUndefined();
  expect(videoType({ isTypeSupported: () => false })).toBeUndefined();
});

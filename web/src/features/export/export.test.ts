import { afterEach, expect, it, vi } from 'vitest';
import { stateAt } from '../../lab/testing';
import { phaseOf, stoppedBy } from '../../lab/testingFacts';
import { caption, fileName } from './picture';
import { record, videoEnding, videoType } from './video';

afterEach(() => {
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

const GOAL: [number, number, number] = [0.1, -0.3, 0];
const at = (change: Parameters<typeof stateAt>[1]) =>
  stateAt(1537, { controller: 'rl', goal_m: GOAL, ...change });

it('names a file by map, controller and time of the trial', () => {
  expect(fileName('colon', at({}), 'png')).toBe('ferry-colon-rl-12.3s.png');
  expect(fileName('map-1', stateAt(0), 'webm')).toBe('ferry-map-1-attractor-0.0s.webm');
});

it.each([
  [{ phase: phaseOf('transporting') }, 'on the way'],
  [{ phase: phaseOf('approaching') }, 'on the way'],
  [{ phase: phaseOf('settling') }, 'goal reached'],
  [{ phase: phaseOf('delivered') }, 'delivered'],
  [{ phase: stoppedBy('leg_steps', 150) }, 'not reached'],
  [{ phase: stoppedBy('goal_steps', 600) }, 'not reached'],
  [{ phase: stoppedBy('walled_off') }, 'not reached'],
  [{ phase: stoppedBy('settle') }, 'reached, not delivered'],
  [{ phase: phaseOf('lifted_off') }, 'lifted off'],
  [{ phase: phaseOf('holding'), goal_m: null }, 'no goal'],
])('the caption of %j ends with “%s”', (change, words) => {
  expect(caption('colon', at(change))).toBe(`colon · RL · t = 12.3 s · ${words}`);
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

it.each(['made', 'started'])('leaves nothing behind if the recorder cannot be %s', (step) => {
  vi.useFakeTimers();
  vi.stubGlobal('cancelAnimationFrame', () => undefined);
  vi.stubGlobal(
    'MediaRecorder',
    class extends EventTarget {
      constructor() {
        super();
        if (step === 'made') throw new Error('made');
      }
      start(): void {
        throw new Error('started');
      }
    },
  );
  const stop = vi.fn();
  const canvas = { captureStream: () => ({ getTracks: () => [{ stop }] }) };
  const onEnd = vi.fn();
  expect(() =>
    record(canvas as unknown as HTMLCanvasElement, 'video/webm', () => undefined, onEnd),
  ).toThrow(step);
  expect(stop).toHaveBeenCalledOnce();
  expect(vi.getTimerCount()).toBe(0);
  expect(onEnd, 'the error is thrown').not.toHaveBeenCalled();
});

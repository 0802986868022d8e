import { describe, expect, it } from 'vitest';
import type { EventKind, EventMessage, Happening, StateMessage } from '../../net/protocol.gen';
import { sceneOf, stateAt } from '../../lab/testing';
import { eventAt, phaseOf, stoppedBy } from '../../lab/testingFacts';
import { deliveriesTo, startTrack, type Frame, observe, type Track } from './track';

const scene = sceneOf('posts', 3);

function event(time_s: number, kind: EventKind, what?: Happening): EventMessage {
  return eventAt(time_s / 0.008, kind, what);
}

const reason = { code: 'held', error_m: 0, threshold_m: 0.1, text: '' } as const;
const LOST = { code: 'took_over', sub_controller: 1, reason } as const;
const FETCHED = { code: 'took_over', sub_controller: 2, reason } as const;

function frame(
  time_s: number,
  change: Partial<StateMessage> = {},
  marks: readonly EventMessage[] = [],
): Frame {
  const tick = Math.round(time_s / 0.008);
  const state = stateAt(tick, {
    tool_m: [0, 0, 0.1],
    tracking_error_m: 0,
    mode: 2,
    phase: phaseOf('transporting'),
    ...change,
  });
  return { scene, state, overlay: undefined, marks };
}

function trackOf(frames: readonly Frame[]): Track {
  return frames.reduce(observe, startTrack(frame(0)));
}

describe('a track', () => {
  it('measures the path length, and the greatest distance in total and while carrying', () => {
    const track = trackOf([
      frame(1, { tool_m: [0.04, 0, 0.1], tracking_error_m: 0.016 }),
      frame(2, { tool_m: [0.04, 0.03, 0.1], tracking_error_m: 0.01 }),
      frame(3, {
        tool_m: [0.04, 0.03, 0.1],
        tracking_error_m: 0.2,
        phase: phaseOf('approaching'),
        mode: 1,
      }),
    ]);
    expect(track.travelled_m).toBeCloseTo(0.07, 9);
    expect(track.carryingError_m).toBe(0.016);
    expect(track.greatestError_m).toBe(0.2);
  });

  it('does not count an error while the hand holds the bead', () => {
    const track = trackOf([frame(1, { tracking_error_m: 0.09, hand_m: [0.1, 0] })]);
    expect(track.carryingError_m).toBe(0);
  });

  it('counts losses and keeps the times of the first loss and fetch, also with few frames', () => {
    const marks = [
      // The literal law may start with a fetch.
      event(1, 'switch', FETCHED),
      event(2, 'switch', LOST),
      event(3.5, 'switch', FETCHED),
      event(5, 'switch', LOST),
    ];
    const track = trackOf([frame(6, { switches: 4 }, marks)]);
    expect(track).toMatchObject({ losses: 2, lostAt_s: 2, fetchedAt_s: 3.5, switches: 4 });
    // The oldest events may be missing.
    expect(trackOf([frame(6, {}, marks), frame(7, {}, marks.slice(3))])).toMatchObject({
      losses: 2,
      lostAt_s: 2,
      fetchedAt_s: 3.5,
    });
  });

  it('counts the plans up to each delivery', () => {
    const overlay = (plans: number, time_s: number): Frame['overlay'] =>
      ({ tick: Math.round(time_s / 0.008), plan: { plans } }) as unknown as Frame['overlay'];
    const there = event(10, 'delivered');
    const back = event(20, 'delivered');
    const track = trackOf([
      { ...frame(5), overlay: overlay(9, 5) },
      { ...frame(10, {}, [there]), overlay: overlay(13, 9.9) },
      { ...frame(15, {}, [there]), overlay: overlay(13, 15) },
      // A slow page gets the event before the overlay of the same step.
      { ...frame(20, {}, [there, back]), overlay: overlay(13, 15) },
      { ...frame(20, {}, [there, back]), overlay: overlay(14, 19.9) },
    ]);
    expect(track.deliveries).toEqual([
      { time_s: 10, goal_m: null, plans: 13 },
      { time_s: 20, goal_m: null, plans: 14 },
    ]);
  });

  it('knows the goal of each delivery', () => {
    const placed = (time_s: number, x_m: number): EventMessage =>
      event(time_s, 'goal', { code: 'goal_placed', x_m, y_m: -0.3 });
    const run = {
      ...scene,
      scenario: { ...scene.scenario, goal_m: [0.1, -0.3] as [number, number] },
    };
    const marks = [event(10, 'delivered'), placed(11, 0.2), event(20, 'delivered')];
    const track = observe(startTrack({ ...frame(0), scene: run }), {
      ...frame(21, {}, marks),
      scene: run,
    });
    expect(track.deliveries.map(({ goal_m }) => goal_m)).toEqual([
      [0.1, -0.3],
      [0.2, -0.3],
    ]);
    expect(deliveriesTo(track).map(({ time_s }) => time_s)).toEqual([10]);
  });

  it('measures how long the tool stayed in one place during a transport', () => {
    const at = (x: number): Partial<StateMessage> => ({ tool_m: [x, 0, 0.1] });
    const frames = [frame(1, at(0.04)), frame(2, at(0.08)), frame(5, at(0.09)), frame(9, at(0.07))];
    // The tool arrived there at 2 s.
    expect(trackOf(frames).lingered_s).toBeCloseTo(7, 6);
    const holding = frames.map((frame) => ({
      ...frame,
      state: { ...frame.state, phase: phaseOf('delivered') },
    }));
    expect(trackOf(holding).lingered_s).toBe(0);
    const stopped = frames.map((frame) => ({
      ...frame,
      state: { ...frame.state, phase: stoppedBy('leg_steps', 150) },
    }));
    expect(trackOf(stopped).lingered_s).toBeCloseTo(7, 6);
  });

  it('keeps the height at which the bead jumped', () => {
    const track = trackOf([
      frame(1, { lift_ratio: 0.98, tool_m: [0, 0, 0.095] }),
      frame(2, { lift_ratio: 1.2, tool_m: [0, 0, 0.094], phase: phaseOf('lifted_off') }),
      frame(3, { lift_ratio: 9, tool_m: [0, 0, 0.09], phase: phaseOf('lifted_off') }),
    ]);
    expect(track.liftedAt_m).toBe(0.094);
  });

  it('is not changed by another trial', () => {
    const track = trackOf([frame(1)]);
    expect(observe(track, { ...frame(2), scene: sceneOf('posts', 4) })).toBe(track);
  });
});

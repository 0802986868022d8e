import { describe, expect, it } from 'vitest';
import { History } from '../../lab/history';
import type { EventMessage } from '../../net/protocol.gen';
import { sceneOf, stateAt } from '../../lab/testing';
import { eventAt } from '../../lab/testingFacts';
import { figureSvg } from './figureSvg';
import { axisRange, PARTS, partRange, rulesOf, thresholdAbove } from './parts';
import { Rotation } from './rotation';
import { csvOf, nearestIndex, spansOf, takeSample, thinnedIndices } from './sample';
import { laneTicks, roundTicks } from './ticks';
import type { Palette } from '../../ui/palette';

const disturbanceAt = (tick: number): EventMessage => eventAt(tick, 'disturbance');

function run(count: number, change: (tick: number) => Parameters<typeof stateAt>[1] = () => ({})) {
  const history = new History();
  for (let tick = 0; tick < count; tick++) history.push(stateAt(tick, change(tick)));
  return history;
}

const ALL = { from_s: 0, to_s: Infinity };

describe('a sample', () => {
  it('keeps a peak of one tick among thousands', () => {
    const history = run(50_000, (tick) => ({ tracking_error_m: tick === 31_234 ? 9 : 0.1 }));
    const { columns } = takeSample(history, ALL, history.newest_s, []);
    expect(columns.tick.length).toBeLessThan(2500);
    expect(columns.tick[columns.error_m.indexOf(9)]).toBe(31_234);
    expect(columns.tick[0]).toBe(0);
    expect(columns.tick.at(-1)).toBe(49_999);
    expect([...columns.tick]).toEqual([...columns.tick].sort((a, b) => a - b));
  });

  it('keeps all samples of a short history', () => {
    expect(thinnedIndices(4, [new Float64Array(4)], 2)).toEqual([0, 1, 2, 3]);
  });

  it('has the times of sub-controller 1 and of the disturbances', () => {
    const history = run(2000, (tick) => ({ mode: tick >= 500 && tick < 700 ? 1 : 2 }));
    const sample = takeSample(history, { from_s: 0, to_s: 16 }, 4, [
      disturbanceAt(500),
      { ...disturbanceAt(600), kind: 'goal' },
      disturbanceAt(9000),
    ]);
    expect(sample.approaches).toEqual([[4, expect.closeTo(5.6)]]);
    expect(sample.struck).toEqual([{ time_s: 4, at_m: [-499, 0] }]);
    expect(sample.at_s).toBe(4);
  });

  it('includes a fetch that has not ended', () => {
    expect(spansOf(Float64Array.of(0, 1, 2), Float64Array.of(2, 1, 1), 1)).toEqual([[1, 2]]);
  });

  it('is found by the nearest time', () => {
    const times = Float64Array.of(0, 1, 5);
    expect([-1, 0.4, 0.6, 2.9, 3.1, 99].map((time) => nearestIndex(times, time))).toEqual([
      0, 0, 1, 1, 2, 2,
    ]);
    expect(nearestIndex(new Float64Array(), 1)).toBeUndefined();
  });

  it('becomes a table with every sample', () => {
    const history = run(3);
    const lines = csvOf(history, takeSample(history, ALL, 0, [disturbanceAt(1)]))
      .trim()
      .split('\n');
    expect(lines).toHaveLength(4);
    expect(lines[0]).toMatch(/^tick,sim_time_s,tool_x_m.*,mode,controller,disturbed$/);
    expect(lines[2]).toBe('1,0.008,1,0,-1,0,2,0,2,1,attractor,1');
    expect(lines[3]?.endsWith(',0')).toBe(true);
  });
});

describe('a rotation', () => {
  it('draws one part per frame, and another round for new data', () => {
    const frames: (() => void)[] = [];
    const done: (string | number)[] = [];
    const rotation = new Rotation(
      () => 3,
      () => done.push('begin'),
      (part) => done.push(part),
      (work) => frames.push(work),
    );
    rotation.offer();
    rotation.offer();
    expect(frames).toHaveLength(1);
    frames.shift()?.();
    rotation.offer();
    while (frames.length > 0) frames.shift()?.();
    expect(done).toEqual(['begin', 0, 1, 2, 'begin', 0, 1, 2]);
    rotation.offer();
    rotation.stop();
    frames.shift()?.();
    expect(done).toHaveLength(8);
  });
});

describe('the axes', () => {
  it('end on multiples of the grain and span at least two', () => {
    expect(axisRange(0.2, 0.2, 2)).toEqual([-1, 3]);
    expect(axisRange(0, 9.2, 2)).toEqual([0, 10]);
  });

  it('show the threshold only when the data come near it', () => {
    const part = PARTS.find(({ threshold }) => threshold);
    if (!part) throw new Error('no part with a threshold');
    const shown = (max: number) => {
      const range = partRange(part, [Float64Array.of(0, max)], 0.1);
      const rules = rulesOf(part, undefined, 0.1, range).map(({ at }) => at);
      return [range, rules, thresholdAbove(part, 0.1, range)];
    };
    expect(shown(1.5)).toEqual([[0, 2], [], 'T = 10.0 cm above']);
    expect(shown(6)).toEqual([[0, 13], [10], undefined]);
  });

  it('have numbers between their ends in a high lane only', () => {
    expect(laneTicks([0, 2], 40)).toEqual([]);
    expect(laneTicks([0, 2], 130)).toEqual([0, 0.5, 1, 1.5, 2]);
  });

  it('have round ticks', () => {
    expect(roundTicks(0, 60, 4)).toEqual([0, 20, 40, 60]);
    expect(roundTicks(-0.1, 0.1, 4).map((tick) => Number(tick.toFixed(6)))).toEqual([
      -0.1, -0.05, 0, 0.05, 0.1,
    ]);
  });
});

describe('the figure as a file', () => {
  it('has six parts and escapes markup in text', () => {
    const history = run(2000, (tick) => ({
      mode: tick < 300 ? 1 : 2,
      bead_m: [tick / 1e4, -0.3, 0],
      tool_m: [tick / 1e4, -0.35, 0],
    }));
    const { workspace } = sceneOf('posts');
    const palette = new Proxy({}, { get: (_target, name) => `#${String(name)}` }) as Palette;
    const svg = figureSvg({
      title: 'a <map> & more',
      palette,
      sample: takeSample(history, { from_s: 0, to_s: 16 }, 16, [disturbanceAt(1000)]),
      threshold_m: 0.1,
      workspace,
      walls: [
        {
          exterior: [
            [0, -0.3],
            [0.1, -0.3],
            [0.1, -0.4],
          ],
          holes: [],
        },
      ],
      goal_m: [0.1, -0.3],
    });
    for (const letter of 'abcdef') expect(svg).toContain(`(${letter}) `);
    expect(svg).not.toContain('<map>');
    expect(svg).not.toMatch(/NaN|Infinity|undefined|style=/);
    // One disturbance: a vertical line in each part over time, a cross in the plane.
    expect(svg.match(/stroke="#you"/g)).toHaveLength(5 + 2);
    expect(svg.match(/fill="#ink-3" fill-opacity/g)).toHaveLength(5);
  });
});

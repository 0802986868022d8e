// The curves of trainings: their values, and their axis of updates. Pure.

import type { Examination, TrainingPoint, TrainingSummary } from '../../net/protocol.gen';
import type { Interval, Measure } from '../../ui/series';
import type { Along } from '../../ui/SeriesPlot';

export interface Kind extends Measure {
  readonly id: 'reward' | 'loss' | 'exploring' | 'examination';
  readonly values: (point: TrainingPoint) => Interval;
  readonly help: string;
}

/** Ends of an axis around the values, with some room. */
export function rangeAround(max: number, min: number): [number, number] {
  // A plot without values has no least and greatest one.
  if (!Number.isFinite(max) || !Number.isFinite(min)) return [0, 1];
  const room = Math.max(0.02, 0.06 * (max - min));
  return [min - room, max + room];
}

const SHARE = {
  unit: '% of episodes',
  digits: 0,
  suffix: ' %',
  axisDigits: 0,
  range: (): [number, number] => [0, 100],
};

export const KINDS: readonly Kind[] = [
  {
    id: 'reward',
    title: 'Reward',
    unit: 'per episode',
    values: ({ reward_mean: mean, reward_deviation }) => {
      const deviation = reward_deviation ?? 0;
      return mean === null ? [null, null, null] : [mean + deviation, mean - deviation, mean];
    },
    digits: 2,
    axisDigits: 2,
    range: rangeAround,
    intervals: 'band',
    help: 'Sum of the rewards of an episode: the mean, with its standard deviation as a band.',
  },
  {
    id: 'loss',
    title: 'Loss',
    unit: 'per update',
    values: ({ loss_mean }) => [null, null, loss_mean],
    digits: 3,
    axisDigits: 2,
    range: rangeAround,
    intervals: 'band',
    help: 'How far the network’s predictions were from what happened. It need not fall to zero.',
  },
  {
    ...SHARE,
    id: 'exploring',
    title: 'Reached while exploring',
    values: ({ reached, ended }) => [null, null, ended === 0 ? null : (100 * reached) / ended],
    intervals: 'band',
    help: 'Share of the episodes of the training that reached their goals, random steps included.',
  },
  {
    ...SHARE,
    id: 'examination',
    title: 'Reached in examinations',
    values: ({ examined }) => {
      if (!examined) return [null, null, null];
      const share = examined.reached / examined.episodes;
      const [low, high] = examined.all_pairs ? [share, share] : examined.reached_wilson95;
      return [100 * high, 100 * low, 100 * share];
    },
    intervals: 'both',
    help: 'Without random steps, with random starts and goals (bar: the 95 % interval) or all of a tiny map.',
  },
];

/** The points with the last examination, which is not part of them. */
export function withLast(
  points: readonly TrainingPoint[],
  update: number,
  examined: Examination | null,
): readonly TrainingPoint[] {
  if (!examined) return points;
  const last = points.at(-1);
  if (last?.update === update) return [...points.slice(0, -1), { ...last, examined }];
  const { steps = 0, episodes = 0 } = last ?? {};
  const nothing = { reward_mean: null, reward_deviation: null, loss_mean: null };
  return [...points, { update, steps, episodes, ...nothing, ended: 0, reached: 0, examined }];
}

/** The last examination once a training is done, before that the newest small one, and the updates before it. */
export function newestExamination(
  { stage, updates: update, examined }: TrainingSummary,
  points: readonly TrainingPoint[],
) {
  if (stage === 'done' && examined) return { examined, update };
  const point = points.findLast((one) => one.examined !== null);
  return point?.examined ? { examined: point.examined, update: point.update } : undefined;
}

/** Updates between two examinations. */
const EXAMINED_EVERY = 1000;

/** When the first examination comes, while there is no point. */
export function firstWords(total: number, isOver: boolean): string {
  if (isOver) return 'It ended before its first examination.';
  return total < EXAMINED_EVERY
    ? 'No examination yet: the only one comes at the end.'
    : `No examination yet: the first comes after ${EXAMINED_EVERY} updates.`;
}

/** Ends of the axis of updates, as a multiple of the last one: its mark is inside the plot. */
const ROOM = 1.02;

const ROUND = [1, 2, 2.5, 5];

/** Where the axis of `total` updates has numbers, `most` of them at most: with the end among them if a round step fits. */
export function updateSplits(total: number, most: number): number[] {
  const steps = [1, 10, 100, 1000, 10_000].flatMap((ten) => ROUND.map((one) => one * ten));
  const wide = steps.filter((step) => Number.isInteger(step) && total / step <= Math.max(1, most));
  const step = wide.find((one) => total % one === 0 && total / one >= 2) ?? wide[0] ?? total;
  return Array.from({ length: Math.floor(total / step) + 1 }, (_, index) => index * step);
}

/** `500`, `1.5k`: as an axis shows updates. */
export function updateText(updates: number): string {
  return updates >= 1000 && updates % 100 === 0 ? `${updates / 1000}k` : String(updates);
}

/** The axis of all updates of a training. */
export const alongUpdates = (total: () => number): Along => ({
  words: 'the updates',
  at: (update) => `After ${update} updates`,
  xRange: () => [0, ROOM * total()],
  xSplits: (most) => updateSplits(total(), most),
  xText: updateText,
});

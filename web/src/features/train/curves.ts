// The curves of one training or two, as columns of a plot. Pure.

import { fixed } from '../../ui/format';
import type { Examination, TrainingPoint, TrainingSummary } from '../../net/protocol.gen';

type Column = (number | null)[];

export interface Kind {
  readonly id: 'reward' | 'loss' | 'exploring' | 'examination';
  readonly title: string;
  readonly unit: string;
  /** The edges of the band, upper one first, and the line. Null where a point has no value. */
  readonly values: (point: TrainingPoint) => readonly [number | null, number | null, number | null];
  /** Ends of the axis; without, around the values. */
  readonly range?: readonly [number, number];
  readonly digits: number;
  readonly suffix?: string;
  /** Whether only some points have a value. */
  readonly isSparse?: true;
  readonly help: string;
}

export const KINDS: readonly Kind[] = [
  {
    id: 'reward',
    title: 'Reward',
    unit: 'per episode',
    values: ({ reward_mean, reward_deviation }) =>
      reward_mean === null
        ? [null, null, null]
        : [
            reward_mean + (reward_deviation ?? 0),
            reward_mean - (reward_deviation ?? 0),
            reward_mean,
          ],
    digits: 2,
    help: 'Sum of the rewards of an episode: the mean, with its standard deviation as a band.',
  },
  {
    id: 'loss',
    title: 'Loss',
    unit: 'per update',
    values: ({ loss_mean }) => [null, null, loss_mean],
    digits: 3,
    help: 'How far the network’s predictions were from what happened. It need not fall to zero.',
  },
  {
    id: 'exploring',
    title: 'Reached while exploring',
    unit: '% of episodes',
    values: ({ reached, ended }) => [null, null, ended === 0 ? null : (100 * reached) / ended],
    range: [0, 100],
    digits: 0,
    suffix: ' %',
    help: 'Share of the episodes of the training that reached their goals, random steps included.',
  },
  {
    id: 'examination',
    title: 'Reached in examinations',
    unit: '% of episodes',
    values: ({ examined }) =>
      examined
        ? [
            100 * examined.reached_wilson95[1],
            100 * examined.reached_wilson95[0],
            (100 * examined.reached) / examined.episodes,
          ]
        : [null, null, null],
    range: [0, 100],
    digits: 0,
    suffix: ' %',
    isSparse: true,
    help: 'The same without random steps, with random starts and goals. Bar: the 95 % interval. The last examination has the most episodes.',
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

export interface Examined {
  readonly examined: Examination;
  /** Updates before it. */
  readonly update: number;
}

/** The last examination once a training is done, before that the newest small one. */
export function newestExamination(
  { stage, updates, examined }: TrainingSummary,
  points: readonly TrainingPoint[],
): Examined | undefined {
  if (stage === 'done' && examined) return { examined, update: updates };
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

/** The updates of all trainings together, and for each training its columns: upper edge, lower edge, line. */
export function columnsOf(
  kind: Kind,
  curves: readonly (readonly TrainingPoint[])[],
): [number[], ...Column[]] {
  const updates = [...new Set(curves.flatMap((points) => points.map(({ update }) => update)))];
  updates.sort((a, b) => a - b);
  const columns = curves.flatMap((points) => {
    const byUpdate = new Map(points.map((point) => [point.update, kind.values(point)]));
    return ([0, 1, 2] as const).map((part) =>
      updates.map((update) => byUpdate.get(update)?.[part] ?? null),
    );
  });
  return [updates, ...columns];
}

/** Ends of an axis around the values, with some room. */
export function rangeAround(max: number, min: number): [number, number] {
  // A plot without values has no least and greatest one.
  if (!Number.isFinite(max) || !Number.isFinite(min)) return [0, 1];
  const room = Math.max(0.02, 0.06 * (max - min));
  return [min - room, max + room];
}

/** Ends of the axis of updates, as a multiple of the last one: its mark is inside the plot. */
export const ROOM = 1.02;

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

/** The values at one update, for each training that has one; undefined without. */
export function readWords(
  kind: Kind,
  names: readonly string[],
  columns: readonly (readonly (number | null)[])[],
  index: number,
): string | undefined {
  const parts = names.flatMap((name, training) => {
    const [high, low, value] = [1, 2, 3].map((part) => columns[3 * training + part]?.[index]);
    if (typeof value !== 'number') return [];
    const text = (one: number): string => fixed(one, kind.digits);
    const interval =
      kind.isSparse && typeof low === 'number' && typeof high === 'number'
        ? ` (${text(low)} to ${text(high)})`
        : '';
    return [`${name} ${text(value)}${interval}${kind.suffix ?? ''}`];
  });
  return parts.length === 0
    ? undefined
    : `After ${columns[0]?.[index] ?? 0} updates: ${parts.join(', ')}`;
}

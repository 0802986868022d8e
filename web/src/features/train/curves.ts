// The curves of one training or two, as columns of a plot. Pure.

import { fixed } from '../../ui/format';
import type { TrainingPoint } from '../../net/protocol.gen';

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
    isSparse: true,
    help: 'The same without random steps. Band: the 95 % interval, because few episodes are examined.',
  },
];

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

/** `500`, `1.5k`: as an axis shows updates. */
export function updateText(updates: number): string {
  return updates >= 1000 && updates % 100 === 0 ? `${updates / 1000}k` : String(updates);
}

/** The values at one update, for each training. */
export function readWords(
  kind: Kind,
  names: readonly string[],
  columns: readonly (readonly (number | null)[])[],
  index: number,
): string {
  const parts = names.flatMap((name, training) => {
    const value = columns[3 * training + 3]?.[index] ?? null;
    return value === null ? [] : [`${name} ${fixed(value, kind.digits)}`];
  });
  return `After ${columns[0]?.[index] ?? 0} updates: ${parts.join(', ')}`;
}

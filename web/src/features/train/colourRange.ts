// The values of the first and the last colour. Pure.

import type { TrainingSummary } from '../../net/protocol.gen';

/** With a smaller difference between them, the noise of the first value maps would have all colours. */
const LEAST_SPAN = 0.3;

/** One range for all value maps of the trainings; undefined without value maps. */
export function colourRange(
  trainings: readonly Pick<TrainingSummary, 'value_range'>[],
): readonly [number, number] | undefined {
  return rangeOf(trainings.flatMap(({ value_range }) => value_range ?? []));
}

/** A range around values; undefined without any. */
export function rangeOf(ends: readonly number[]): readonly [number, number] | undefined {
  if (ends.length === 0) return undefined;
  const [least, greatest] = [Math.min(...ends), Math.max(...ends)];
  const room = Math.max(0, (LEAST_SPAN - (greatest - least)) / 2);
  return [least - room, greatest + room];
}

// Rows as text: in the table, and in the files to download. Pure.

import { fixed } from '../../ui/format';
import type { EvaluationFailure } from '../../net/protocol.gen';
import { addressOf } from '../../net/base';

export function percentRange([low, high]: readonly [number, number]): string {
  return `${fixed(100 * low, 0)}–${fixed(100 * high, 0)} %`;
}

/** Centimetres without the unit, which is in the column's head. */
export function cm(value_m: number | null): string {
  return value_m === null ? '–' : fixed(100 * value_m, 1);
}

/** Why a trial failed, in the words of its report. */
export const reason = ({ outcome, trouble, refusal }: EvaluationFailure): string =>
  [outcome, trouble, refusal].filter((why) => why !== null).join('; ');

/** `1.043`, or a dash if no bead was delivered. */
export const ratio = (value: number | null): string => (value === null ? '–' : fixed(value, 3));

/** `−2.5`, `+0.1`: always with a sign. */
export function signed(value: number, digits: number): string {
  const text = fixed(value, digits);
  return value > 0 ? `+${text}` : text;
}

/** The server's files of an evaluation. */
export const REPORTS = ['html', 'csv', 'json'] as const;

export function reportAddress(id: string, ending: (typeof REPORTS)[number]): string {
  return addressOf(`/api/evaluations/${encodeURIComponent(id)}/report.${ending}`);
}

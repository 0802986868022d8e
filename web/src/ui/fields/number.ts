// Numbers as people type them: with a decimal point or a decimal comma. Pure.

export interface Limits {
  readonly min?: number | undefined;
  readonly max?: number | undefined;
  readonly isWhole?: boolean | undefined;
}

const NUMBER = /^[+-]?(\d+[.,]?\d*|[.,]\d+)(e[+-]?\d+)?$/i;
/** `1,000`: a thousand or one. */
const UNCLEAR = /^[+-]?[1-9]\d{0,2},\d{3}$/;
const trimmed = (text: string): string => text.trim().replace('\u2212', '-');

/** NaN if the text is not a number, or an unclear one. */
export function numberOf(text: string): number {
  const digits = trimmed(text);
  return NUMBER.test(digits) && !UNCLEAR.test(digits) ? Number(digits.replace(',', '.')) : NaN;
}

/** Why a text cannot be taken as a number; undefined if it can. */
export function numberFault(text: string, limits: Limits = {}): string | undefined {
  const { min = -Infinity, max = Infinity, isWhole = false } = limits;
  const digits = trimmed(text);
  if (UNCLEAR.test(digits)) {
    const words = [digits.replace(',', '.'), digits.replace(',', '')];
    return `“${text}” is unclear: type ${words.join(' or ')}.`;
  }
  const value = numberOf(text);
  if (!Number.isFinite(value)) return text === '' ? 'Type a number.' : `“${text}” is not a number.`;
  if (value >= min && value <= max && (!isWhole || Number.isSafeInteger(value))) return undefined;
  const first = min > -Infinity ? `from ${min} ` : '';
  const last = max < Infinity ? `${first === '' ? 'up ' : ''}to ${max}` : '';
  return `“${text}” must be a ${isWhole ? 'whole ' : ''}number ${first}${last}`.trim() + '.';
}

export interface Steps extends Limits {
  readonly step?: number | undefined;
}

/** The arrow keys: the next multiple of the step, inside the range. */
export function stepped(
  text: string,
  { min = -Infinity, max = Infinity, step = 1 }: Steps,
  isUp: boolean,
): string {
  // Free of binary dust.
  const steps = Number(((numberOf(text) || 0) / step).toPrecision(12));
  const next = (isUp ? Math.floor(steps) + 1 : Math.ceil(steps) - 1) * step;
  return String(Number(Math.min(max, Math.max(min, next)).toPrecision(12)));
}

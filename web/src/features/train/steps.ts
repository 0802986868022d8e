// The arrow keys of a number field: from one round number to the next. Pure.

export interface Steps {
  readonly min: number;
  readonly max?: number;
  readonly step: number;
  readonly isWhole?: true;
}

/** The next multiple of the step, inside the range. */
export function stepped(text: string, { min, max = Infinity, step }: Steps, isUp: boolean): string {
  // Free of binary dust.
  const steps = Number((Number(text) / step).toPrecision(12));
  const next = (isUp ? Math.floor(steps) + 1 : Math.ceil(steps) - 1) * step;
  return String(Number(Math.min(max, Math.max(min, next)).toPrecision(12)));
}

// How each parameter is shown and within which range it is asked. The server has the last word.

import type { ControllerName, Parameters } from '../net/protocol.gen';

/** Sub-controllers 2 as the page names them. */
export const CONTROLLER_LABELS: Readonly<Record<ControllerName, string>> = {
  rl: 'RL',
  errt: 'ERRT',
  attractor: 'Attractor',
};

export type NumberName = {
  [K in keyof Parameters]: Parameters[K] extends number ? K : never;
}[keyof Parameters];
type FlagName = {
  [K in keyof Parameters]: Parameters[K] extends boolean ? K : never;
}[keyof Parameters];
type ChoiceName = Exclude<keyof Parameters, NumberName | FlagName>;

export interface NumberField {
  readonly kind: 'number';
  readonly name: NumberName;
  readonly label: string;
  readonly help: string;
  readonly unit: string;
  /** Shown value = stored value × scale. */
  readonly scale: number;
  /** In shown units. */
  readonly min: number;
  readonly max: number;
  readonly step: number;
  /** What other parameters leave of the range, from above, in the stored unit. */
  readonly atMost?: (parameters: Parameters) => number;
}

export interface ChoiceField {
  readonly kind: 'choice';
  readonly name: ChoiceName;
  readonly label: string;
  readonly help: string;
  readonly options: readonly (readonly [value: string, label: string])[];
}

export interface FlagField {
  readonly kind: 'flag';
  readonly name: FlagName;
  readonly label: string;
  readonly help: string;
}

export type Field = NumberField | ChoiceField | FlagField;

export interface Group {
  readonly title: string;
  /** The controller that these are for, if for one alone. */
  readonly controller?: ControllerName;
  /** Whether it is open at first. */
  readonly open?: boolean;
  readonly fields: readonly Field[];
}

/** A field for a number; its range and step are in the shown unit. */
export function number(
  name: NumberName,
  label: string,
  [min, max, step]: readonly [number, number, number],
  unit: string,
  scale: number,
  help: string,
): NumberField {
  return { kind: 'number', name, label, help, unit, scale, min, max, step };
}

/** Digits after the point that `step` asks for. */
export function digits(step: number): number {
  return Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
}

/** From the stored unit to the shown one, free of binary dust. */
export function shownValue(field: NumberField, stored: number): number {
  return Number((stored * field.scale).toPrecision(12));
}

/** Greatest value that may be shown now. */
export function shownMost(field: NumberField, parameters: Parameters): number {
  return field.atMost
    ? Math.min(field.max, shownValue(field, field.atMost(parameters)))
    : field.max;
}

/** From the shown unit to the stored one, inside the field's range. */
export function storedValue(field: NumberField, shown: number, parameters: Parameters): number {
  const inside = Math.min(field.max, Math.max(field.min, shown));
  // What counts is whole, whatever is typed.
  const whole = field.scale === 1 && field.step === 1 ? Math.round(inside) : inside;
  const stored = Number((whole / field.scale).toPrecision(12));
  return field.atMost ? Math.min(stored, field.atMost(parameters)) : stored;
}

/** `change`, and what it takes along: parameters that would be beyond what it leaves them. */
export function withFollowers(
  groups: readonly Group[],
  parameters: Parameters,
  change: Partial<Parameters>,
): Partial<Parameters> {
  const next = { ...parameters, ...change };
  const followers: Partial<Parameters> = {};
  for (const field of groups.flatMap((group) => group.fields)) {
    if (field.kind !== 'number' || !field.atMost) continue;
    const most = field.atMost(next);
    if (next[field.name] > most) followers[field.name] = most;
  }
  return { ...change, ...followers };
}

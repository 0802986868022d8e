// The form's fields, from the server's table, and how their values are shown and stored.

import { GROUPS as GENERATED, PRESETS } from '../net/parameters.gen';
import {
  type Branch,
  CONTROLLER_LABELS,
  CONTROLLERS,
  type ControllerName,
  type Parameters,
} from '../net/protocol.gen';
import type { Option } from '../ui/fields/fields';
import { shownName } from '../ui/name';

export { CONTROLLER_LABELS, CONTROLLERS };

/** The name of a controller, or of the program that is one. */
export const controllerLabel = ({
  controller,
  program,
}: Pick<Branch, 'controller' | 'program'>): string =>
  program === null ? CONTROLLER_LABELS[controller] : shownName(program);

const LABELS: Readonly<Partial<Record<string, string>>> = CONTROLLER_LABELS;

/** The name of a controller, or of a program, in a list of both. */
export const labelOf = (name: string): string => LABELS[name] ?? shownName(name);

/** What each controller does, one or two sentences. */
export const CONTROLLER_HELP: Readonly<Record<ControllerName, string>> = {
  rl: 'A trained network. From the camera’s picture it judges four directions, step by step.',
  errt: 'A path planner. It plans a path around the walls it has seen, and again at each new one.',
  attractor: 'No plan. It heads for the goal, and walls in view bend its motion. It can get stuck.',
  replanner:
    'The shortest path around the walls it has seen, and a new one at each new wall. A reference for evaluations.',
  you: 'Your hand points the tool to a place, and it goes there as fast as the controllers may.',
  program:
    'A program outside of Ferry. It gets the image at each step, and answers where the tool goes.',
  robot: 'A program for a UR5 commands the joints. Neither sub-controller moves the arm.',
};

export type NumberName = {
  [K in keyof Parameters]: Parameters[K] extends number ? K : never;
}[keyof Parameters];
type FlagName = {
  [K in keyof Parameters]: Parameters[K] extends boolean ? K : never;
}[keyof Parameters];
type ChoiceName = Exclude<keyof Parameters, NumberName | FlagName | 'rl_policy'>;

interface FieldBase {
  readonly label: string;
  readonly help: string;
}

export interface NumberField extends FieldBase {
  readonly kind: 'number';
  readonly name: NumberName;
  readonly unit: string;
  /** Shown value = stored value × scale. */
  readonly scale: number;
  /** In shown units. */
  readonly min: number;
  readonly max: number;
  readonly step: number;
  /** Whether it counts something. */
  readonly isWhole: boolean;
  /** How another parameter limits it from above: at most the other one, or both together at most 1. */
  readonly bound?: {
    readonly kind: 'atMost' | 'quarter' | 'remainder';
    readonly other: NumberName;
  };
}

interface ChoiceField extends FieldBase {
  readonly kind: 'choice';
  readonly name: ChoiceName;
  readonly options: readonly Option[];
}

/** One of the shipped policies, or an added one. */
export interface PolicyField extends FieldBase {
  readonly kind: 'policy';
  readonly name: 'rl_policy';
  readonly options: readonly Option[];
}

interface FlagField extends FieldBase {
  readonly kind: 'flag';
  readonly name: FlagName;
}

export type Field = NumberField | ChoiceField | PolicyField | FlagField;

/** The name in a policy's reference: `NAME` or `NAME@HASH`. */
export const policyName = (reference: string): string => reference.split('@')[0] ?? reference;

/** The shipped policies, the added ones, and the value itself, which may have been deleted. */
export function policyOptions(
  { options }: PolicyField,
  added: readonly string[],
  value: string,
): readonly Option[] {
  const known = [...options, ...added.map((one) => [one, policyName(one)] as const)];
  return known.some(([one]) => one === value)
    ? known
    : [...known, [value, `${policyName(value)} (not on this server)`]];
}

export interface Group {
  readonly title: string;
  /** The controller that these are for, if for one alone. */
  readonly controller?: ControllerName;
  /** Whether it is open at first. */
  readonly open: boolean;
  readonly fields: readonly Field[];
}

export const GROUPS: readonly Group[] = GENERATED;

export const FIELDS: readonly Field[] = GROUPS.flatMap((group) => group.fields);

/** What presets choose between, with the presets of each. */
export const PRESET_KINDS = [...new Set(PRESETS.map(({ kind }) => kind))].map((label) => ({
  label,
  presets: PRESETS.filter(({ kind }) => kind === label),
}));

export type PresetKind = (typeof PRESET_KINDS)[number];

/** Index of the preset whose values these are; -1 if they are those of none. */
export function presetOf({ presets }: PresetKind, parameters: Parameters): number {
  const isThis = ({ values }: (typeof PRESETS)[number]): boolean =>
    Object.entries(values).every(([name, value]) => parameters[name as keyof Parameters] === value);
  return presets.findIndex(isThis);
}

/** Least and greatest value in the stored unit. */
export function storedRange(name: NumberName): readonly [number, number] {
  const field = FIELDS.find((one) => one.name === name);
  if (field?.kind !== 'number') throw new Error(`${name} is not a number parameter`);
  return [field.min / field.scale, field.max / field.scale];
}

/** Greatest value that another parameter leaves, in the stored unit. */
function boundOf({ bound }: NumberField, parameters: Parameters): number {
  if (!bound) return Infinity;
  const other = parameters[bound.other];
  return { atMost: other, quarter: other / 4, remainder: 1 - other }[bound.kind];
}

/** Digits after the point that `step` needs. */
export const digits = (step: number): number => Math.max(0, -Math.floor(Math.log10(step) + 1e-9));

/** From the stored unit to the shown one, free of binary dust. */
export function shownValue(field: NumberField, stored: number): number {
  return Number((stored * field.scale).toPrecision(12));
}

/** Greatest value that may be shown now. */
export function shownMost(field: NumberField, parameters: Parameters): number {
  return Math.min(field.max, shownValue(field, boundOf(field, parameters)));
}

/** From the shown unit to the stored one, inside the field's range. */
export function storedValue(field: NumberField, shown: number, parameters: Parameters): number {
  const inside = Math.min(field.max, Math.max(field.min, shown));
  const whole = field.isWhole ? Math.round(inside) : inside;
  const stored = Number((whole / field.scale).toPrecision(12));
  return Math.min(stored, boundOf(field, parameters));
}

/** `change`, and the parameters that it leaves no room for, lowered to their new limits. */
export function withFollowers(
  parameters: Parameters,
  change: Partial<Parameters>,
): Partial<Parameters> {
  const next = { ...parameters, ...change };
  const followers: Partial<Parameters> = {};
  for (const field of FIELDS) {
    if (field.kind !== 'number') continue;
    const most = boundOf(field, next);
    if (next[field.name] > most) followers[field.name] = most;
  }
  return { ...change, ...followers };
}

// Varied parameters in the words and units of the page. Pure.

import { FIELDS, GROUPS, type NumberField } from '../../lab/parameters';
import type { Setting } from '../../net/protocol.gen';

/** The parameters that can be varied. */
export const NUMBERS: readonly NumberField[] = FIELDS.filter((field) => field.kind === 'number');

/** Names of the server are known to the page: both are generated from one table. */
export function numberField(name: string): NumberField {
  const field = NUMBERS.find((one) => one.name === name);
  if (!field) throw new Error(`${name} is not a number parameter`);
  return field;
}

/** `Tracker: Noise σ, mm`: the same label may occur in two groups. */
export function axisWords(name: string): string {
  const { label, unit } = numberField(name);
  const group = GROUPS.find(({ fields }) => fields.some((field) => field.name === name));
  const words = group ? `${group.title}: ${label}` : label;
  return unit === '' ? words : `${words}, ${unit}`;
}

/** A stored value in the shown unit, without the noise of binary fractions. */
export function shown(name: string, value: number): number {
  return Number((value * numberField(name).scale).toPrecision(6));
}

/** `T 2.5 cm, Friction 0.3`; empty without any. */
export function variedWords(varied: readonly Setting[]): string {
  const word = ({ name, value }: Setting): string => {
    const { label, unit } = numberField(name);
    return [label, shown(name, value), unit].filter((part) => part !== '').join(' ');
  };
  return varied.map(word).join(', ');
}

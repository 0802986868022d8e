// What is wrong with the form, in a few words beside its button. Pure.

import { type Faults, SETTINGS } from './recipes';

const LABELS: Readonly<Partial<Record<string, string>>> = {
  map: 'Map',
  name: 'Policy name',
  start_from: 'Start from',
  recipe: 'Recipe',
  seed: 'Seed',
  ...Object.fromEntries(SETTINGS.map(({ name, label }) => [`settings.${name}`, label])),
};

/** Undefined if no field is wrong. Why is shown at the field. */
export function faultWords(faults: Faults): string | undefined {
  const wrong = Object.keys(faults).flatMap((field) => {
    const label = LABELS[field];
    return label === undefined || faults[field] === undefined ? [] : [label];
  });
  if (wrong.length > 1) return `${wrong.length} fields are wrong.`;
  return wrong[0] === undefined ? undefined : `${wrong[0]} is wrong.`;
}

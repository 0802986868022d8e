import { expect, it } from 'vitest';
import { colourRange } from './colourRange';

const of = (...ranges: ([number, number] | null)[]) =>
  colourRange(ranges.map((value_range) => ({ value_range })));

it('has the values of all trainings', () => {
  expect(of([-0.5, 1])).toEqual([-0.5, 1]);
  expect(of([-0.5, 0.4], null, [0, 0.9])).toEqual([-0.5, 0.9]);
  expect(of()).toBeUndefined();
  expect(of(null)).toBeUndefined();
});

it('does not stretch small differences over all colours', () => {
  const [least, greatest] = of([0.09, 0.11]) ?? [];
  expect(least).toBeCloseTo(-0.05);
  expect(greatest).toBeCloseTo(0.25);
});

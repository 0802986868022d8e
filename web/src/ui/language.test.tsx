import { expect, it } from 'vitest';

it('draws curves where the browser has no valid language', async () => {
  Object.defineProperty(navigator, 'language', { value: 'de_DE' });
  expect(() => new Intl.NumberFormat(navigator.language)).toThrow(RangeError);
  const { default: UPlot } = await import('uplot');
  expect(() => new UPlot({ width: 100, height: 100, series: [{}] }, [[1]])).not.toThrow();
});

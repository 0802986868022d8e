import { expect, it } from 'vitest';
import { addressOf, pathOf } from './base';

it('adds the path at which a proxy has the server, and takes it away', () => {
  expect(addressOf('/api/maps')).toBe('/api/maps');
  expect(addressOf('/api/maps', '/ferry/')).toBe('/ferry/api/maps');
  expect(pathOf('/ferry/s/anna', '/ferry/')).toBe('/s/anna');
  expect(pathOf('/ferry/', '/ferry/')).toBe('/');
  expect(pathOf('/s/anna')).toBe('/s/anna');
});

import { expect, it } from 'vitest';
import { newName, ownAddress } from './ownSession';

it('has names that the server takes, each of them new', () => {
  const names = Array.from({ length: 200 }, newName);
  expect(new Set(names).size).toBe(200);
  for (const name of names) expect(name).toMatch(/^[a-z]+-[a-z]+-[a-z0-9]{5}$/);
  expect(ownAddress('#v=1')).toMatch(/^\/s\/[a-z0-9-]{1,32}#v=1$/);
});

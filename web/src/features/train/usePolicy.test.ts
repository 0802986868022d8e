import { expect, it } from 'vitest';
import { mapFor } from './usePolicy';

it('stays on a map on which the policy was trained, otherwise takes one that exists', () => {
  const all = ['colon', 'open', 'posts'];
  expect(mapFor(['colon', 'posts'], 'posts', all)).toBe('posts');
  expect(mapFor(['removed', 'open'], 'posts', all)).toBe('open');
  expect(mapFor(['generated'], 'posts', all)).toBe('posts');
});

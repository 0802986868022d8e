import { expect, it } from 'vitest';
import { mapFor, nextWords, policyOf } from './policyUse';

it('stays on a map on which the policy was trained, otherwise takes one that exists', () => {
  const all = ['colon', 'open', 'posts'];
  expect(mapFor(['colon', 'posts'], 'posts', all)).toBe('posts');
  expect(mapFor(['removed', 'open'], 'posts', all)).toBe('open');
  expect(mapFor(['generated'], 'posts', all)).toBe('posts');
});

it('finds a policy by its reference, and after a new name by its hash', () => {
  const colon = { name: 'colon', reference: 'colon' };
  const copy = { name: 'copy', reference: 'copy@0123' };
  const mine = { name: 'mine', reference: 'mine@0123' };
  expect(policyOf([colon, copy, mine], 'mine@0123')).toBe(mine);
  expect(policyOf([colon, copy], 'mine@0123')).toBe(copy);
  expect(policyOf([colon, copy], 'mine@4567')).toBeUndefined();
  expect(policyOf([colon], 'colon')).toBe(colon);
  expect(policyOf([copy], 'auto')).toBeUndefined();
});

it('names the next step', () => {
  expect(nextWords('mine', { hasGoal: false, running: false }, false)).toBe(
    'RL drives with the policy mine. Click a place to set the goal, then press Run.',
  );
  expect(nextWords('mine', { hasGoal: true, running: true }, true)).toBe(
    'RL drives with the policy mine. Tap a place to set another goal.',
  );
});

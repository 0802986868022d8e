import { expect, test } from 'vitest';
import { viewModeFrom } from './viewMode';

test('a stored mode is kept; anything else becomes the plan view', () => {
  expect(viewModeFrom('scene')).toBe('scene');
  expect(viewModeFrom('plan')).toBe('plan');
  expect(viewModeFrom(null)).toBe('plan');
  expect(viewModeFrom('toString')).toBe('plan');
});

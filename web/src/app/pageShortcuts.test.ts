import { describe, expect, it } from 'vitest';
import { keyName } from '../ui/shortcuts';
import { pageShortcuts } from './pageShortcuts';
import type { Lab } from '../lab/slices';

const run = (): void => undefined;

describe('the shortcuts of the page', () => {
  it('use each key once per area, and each key has a name', () => {
    const all = pageShortcuts({} as Lab, () => true, run);
    const keys = all.filter((shortcut) => shortcut.run).flatMap((shortcut) => shortcut.keys);
    expect(new Set(keys).size).toBe(keys.length);
    expect(keys.map(keyName)).toContain('Space');
    expect(keyName('r')).toBe('R');
  });
});

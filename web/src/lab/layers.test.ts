import { describe, expect, it } from 'vitest';
import { type KnownLayer, layersFrom } from './layers';

const KNOWN: readonly KnownLayer[] = [{ id: 'plan', shownAtFirst: true }, { id: 'flow' }];

describe('the layers', () => {
  it('are the default without a stored choice', () => {
    expect([...layersFrom(null, KNOWN)]).toEqual(['plan']);
    expect(layersFrom('{', KNOWN)).toEqual(layersFrom(null, KNOWN));
    expect(layersFrom('"plan"', KNOWN)).toEqual(layersFrom(null, KNOWN));
  });

  it('are the stored ones that still exist', () => {
    expect([...layersFrom('["flow","removed",7]', KNOWN)]).toEqual(['flow']);
    expect([...layersFrom('[]', KNOWN)]).toEqual([]);
  });
});

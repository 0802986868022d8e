import { describe, expect, it } from 'vitest';
import { layersFrom } from './layers';

describe('the layers', () => {
  it('are the first ones where nothing was chosen', () => {
    expect(layersFrom(null).has('plan')).toBe(true);
    expect(layersFrom(null).has('flow')).toBe(false);
    expect(layersFrom('{')).toEqual(layersFrom(null));
    expect(layersFrom('"plan"')).toEqual(layersFrom(null));
  });

  it('are those chosen last, as far as there still are such', () => {
    expect([...layersFrom('["flow","gone",7]')]).toEqual(['flow']);
    expect([...layersFrom('[]')]).toEqual([]);
  });
});

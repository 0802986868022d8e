import { describe, expect, it } from 'vitest';
import { type KnownLayer, shownLayers, switchedFrom } from './layers';

const KNOWN: readonly KnownLayer[] = [{ id: 'plan', shownAtFirst: true }, { id: 'flow' }];
const shown = (text: string | null): readonly string[] => [
  ...shownLayers(KNOWN, switchedFrom(text)),
];

describe('the layers', () => {
  it.each([null, '{', '"plan"', '["flow"]', 'null', '{"plan":1}'])(
    'are the default with %s stored',
    (text) => {
      expect(shown(text)).toEqual(['plan']);
    },
  );

  it('are those that were switched, and the default for the others', () => {
    expect(shown('{"flow":true,"removed":true}')).toEqual(['plan', 'flow']);
    expect(shown('{"plan":false}')).toEqual([]);
  });
});

import { describe, expect, it } from 'vitest';
import { LESSONS } from '../features/lessons/lessons';
import { PRESETS } from '../features/share/presets';
import { experimentFrom, type Known, linkText } from '../lab/experimentLink';
import { sceneOf } from '../lab/testing';

const { defaults } = sceneOf('colon');
const KNOWN: Known = {
  maps: [
    'attractor-example',
    'attractor-example-arm',
    'colon',
    'colon-folds',
    'open',
    'posts',
    'vessels',
    // No shipped map has such a name, but one might.
    'Übung & Prüfung #1 = 100 %',
  ],
  controllers: ['rl', 'errt', 'attractor'],
  defaults,
};

describe('links that come with the page', () => {
  const links = [
    ...PRESETS.map(({ name, link }) => [name, link] as const),
    ...LESSONS.flatMap(({ title, runs }) => runs.map(({ link }) => [title, link] as const)),
  ];
  it.each(links)('%s is read, and is what the page would write', (_, link) => {
    const read = experimentFrom(link, KNOWN);
    if (read.kind !== 'experiment') throw new Error(read.kind === 'broken' ? read.why : 'nothing');
    // Else the preset would not be recognised, nor a lesson's experiment.
    expect(linkText(read.experiment, defaults)).toBe(link);
  });

  it('have names of their own', () => {
    expect(new Set(PRESETS.map(({ name }) => name)).size).toBe(PRESETS.length);
    expect(new Set(PRESETS.map(({ link }) => link)).size).toBe(PRESETS.length);
  });
});

import { describe, expect, it } from 'vitest';
import { isTrainingLesson } from '../features/lessons/lesson';
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
    // No built-in map has such a name, but a user's map might.
    'Übung & Prüfung #1 = 100 %',
  ],
  controllers: ['rl', 'errt', 'attractor'],
  defaults,
};

describe('links of presets and lessons', () => {
  const links = [
    ...Object.entries(PRESETS),
    ...LESSONS.flatMap((lesson) =>
      isTrainingLesson(lesson) ? [] : lesson.runs.map(({ link }) => [lesson.title, link] as const),
    ),
  ];
  it.each(links)('%s is read and written back unchanged', (_, link) => {
    const read = experimentFrom(link, KNOWN);
    if (read.kind !== 'experiment') throw new Error(read.kind === 'broken' ? read.why : 'nothing');
    // Otherwise the page would not recognise the preset or the lesson's experiment.
    expect(linkText(read.experiment, defaults)).toBe(link);
  });

  it('are not listed twice', () => {
    const all = Object.values(PRESETS);
    expect(new Set(all).size).toBe(all.length);
  });
});

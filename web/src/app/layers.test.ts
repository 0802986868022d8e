import { expect, it } from 'vitest';
import { isTrainingLesson } from '../features/lessons/lesson';
import { LESSONS } from '../features/lessons/lessons';
import { MAP_LAYERS } from './layers';

const ids = MAP_LAYERS.map(({ id }) => id);

it('layers keep the ids that browsers have stored', () => {
  expect(ids.join(' ')).toBe(
    'singularity value recovery seen rulers flow blocks rectangles sensed obstacles plan ghosts challenge field trail camera capture',
  );
});

it('layers that are shown by default do not cover the map', () => {
  const first = MAP_LAYERS.filter(({ shownAtFirst }) => shownAtFirst).map(({ id }) => id);
  expect(first.sort()).toEqual([
    'camera',
    'capture',
    'challenge',
    'ghosts',
    'plan',
    'recovery',
    'sensed',
    'trail',
  ]);
});

it('layers include those that lessons switch on', () => {
  const wanted = LESSONS.flatMap((lesson) => (isTrainingLesson(lesson) ? [] : lesson.runs)).flatMap(
    ({ layers }) => layers,
  );
  for (const id of wanted) expect(ids).toContain(id);
});

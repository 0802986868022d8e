import { expect, it } from 'vitest';
import { isTrainingLesson } from '../features/lessons/lesson';
import { LESSONS } from '../features/lessons/lessons';
import type { PanelName } from '../lab/panels';
import type { Lab } from '../lab/slices';
import { hiddenBecause, type MapLayer } from '../plan/layer';
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

it('a comparison and a recovery map do not cover each other', () => {
  const hidden = (panel: PanelName): string[] => {
    const lab = { sight: () => 'all', panel: () => panel, scene: () => undefined };
    const isHidden = (layer: MapLayer): boolean =>
      hiddenBecause(layer, lab as unknown as Lab) !== undefined;
    return MAP_LAYERS.filter(({ id }) => id === 'ghosts' || id === 'recovery')
      .filter(isHidden)
      .map(({ id }) => id);
  };
  expect(hidden('compare')).toEqual(['recovery']);
  expect(hidden('recovery')).toEqual(['ghosts']);
  expect(hidden('now')).toEqual([]);
});

it('layers include those that lessons switch on', () => {
  const wanted = LESSONS.flatMap((lesson) => (isTrainingLesson(lesson) ? [] : lesson.runs)).flatMap(
    ({ layers }) => layers,
  );
  for (const id of wanted) expect(ids).toContain(id);
});

// All lessons, in the order in which they build on each other.

import { ATTRACTOR, ERRT, POLICY } from './carryingLessons';
import type { Lesson } from './lesson';
import { LIFT_OFF, MEET_THE_MAGNET } from './magnetLessons';
import { THE_GUT_MOVES } from './movingLessons';
import { LOSE_THE_BEAD, THRESHOLD, TWO_LAWS } from './switchingLessons';
import { FAR_GOAL, FINE_TUNING, LEARNING_FAILS } from './trainingLessons';

interface Group {
  readonly title: string;
  readonly lessons: readonly Lesson[];
}

export const GROUPS: readonly Group[] = [
  { title: 'The magnet', lessons: [MEET_THE_MAGNET, LIFT_OFF] },
  { title: 'Switching', lessons: [LOSE_THE_BEAD, THRESHOLD, TWO_LAWS] },
  { title: 'Carrying', lessons: [ATTRACTOR, ERRT, POLICY, THE_GUT_MOVES] },
  { title: 'Training', lessons: [LEARNING_FAILS, FAR_GOAL, FINE_TUNING] },
];

export const LESSONS: readonly Lesson[] = GROUPS.flatMap(({ lessons }) => lessons);

// All lessons, in the order in which they build on each other.

import { ATTRACTOR, ERRT, POLICY } from './carryingLessons';
import type { Lesson } from './lesson';
import { LIFT_OFF, MEET_THE_MAGNET } from './magnetLessons';
import { THE_GUT_MOVES } from './movingLessons';
import { LOSE_THE_BEAD, THRESHOLD, TWO_LAWS } from './switchingLessons';
import { FAR_GOAL, FINE_TUNING, LEARNING_FAILS } from './trainingLessons';

export const LESSONS: readonly Lesson[] = [
  MEET_THE_MAGNET,
  LOSE_THE_BEAD,
  THRESHOLD,
  TWO_LAWS,
  ATTRACTOR,
  ERRT,
  POLICY,
  THE_GUT_MOVES,
  LEARNING_FAILS,
  FAR_GOAL,
  FINE_TUNING,
  LIFT_OFF,
];

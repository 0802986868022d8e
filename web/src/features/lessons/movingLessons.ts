// A lesson about walls that move.

import { DELIVERED, deliveryWords, type ExperimentLesson, isDelivered, isSlower } from './lesson';

const COLON = '#v=1&map=colon&controller=rl&seed=1&start=0.19,-0.28&goal=-0.24,-0.27';

export const THE_GUT_MOVES: ExperimentLesson = {
  id: 'gut-moves',
  title: 'The gut moves',
  aim: 'See a policy at work between walls that move, which it never saw in training.',
  minutes: 5,
  question:
    'A living gut contracts: waves travel along its walls. The policy was trained between rigid walls, and decides from one camera picture at a time. Now waves of 6 mm come along every 6 seconds. What happens?',
  choices: {
    same: 'It delivers the bead about as fast as before',
    slower: 'It delivers the bead, but takes much longer',
    never: 'It does not deliver the bead',
  },
  runs: [
    {
      title: 'Rigid walls',
      link: COLON,
      speed: 4,
      layers: ['camera', 'trail'],
      words: ['First the walls as they were in training.'],
      tasks: [DELIVERED],
    },
    {
      title: 'Peristalsis',
      link: `${COLON}&peristalsis_amplitude_m=0.006`,
      speed: 4,
      layers: ['camera', 'trail'],
      words: [
        'The same start and goal. After *Run*, the walls begin to move: they close in and open again, one wave after the other.',
        'The waves travel at 2 cm/s, half as fast as the tool.',
      ],
      tasks: [DELIVERED],
    },
    {
      title: 'Strong contractions, and a planner',
      link: '#v=1&map=colon-folds&controller=errt&seed=1&start=0.03,-0.318&goal=0.207,-0.361&peristalsis_amplitude_m=0.012',
      speed: 4,
      layers: ['plan', 'obstacles'],
      words: [
        'Another map with narrower passages, stronger waves, and ERRT. It plans again whenever a wall comes into its path.',
        'Where it finds no path between closed walls, it waits. Then the panel *Now* says why the arm holds.',
      ],
      tasks: [DELIVERED],
    },
  ],
  outcome: (rigid, moving) => {
    if (!isDelivered(moving)) return 'never';
    return isSlower(moving, rigid) ? 'slower' : 'same';
  },
  facts: (rigid, moving, strong) => [
    ['rigid walls: delivered', deliveryWords(rigid)],
    ['waves of 6 mm: delivered', deliveryWords(moving)],
    ['waves of 12 mm, ERRT: delivered', deliveryWords(strong)],
  ],
  why: [
    'The policy looks again at each step and remembers nothing, so a wall that has moved is a new picture and no surprise. It keeps to the middle, where the waves leave room.',
    'A planner has to forget: what the camera saw a while ago may have moved. While the walls move, Ferry’s obstacle map forgets walls that came to a free place, when they have been out of view for some time.',
    'The bead feels the waves too: a wall that closes in pushes it ahead. The magnet is stronger, unless the bead is caught in a closed segment.',
  ],
  paper:
    'Section VI expects that ERRT may be too slow for obstacles that move, and that RL is not. Here both deliver.',
};

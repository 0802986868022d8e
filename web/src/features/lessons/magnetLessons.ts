// The magnet and the bead: how it follows, and when it jumps.

import { centimetres, fixed, millimetres } from '../../ui/format';
import { storedRange } from '../../lab/parameters';
import { DELIVERED, deliveryWords, type Lesson, TIME_RUNS } from './lesson';

/** How much the lesson lowers the magnet at once, and the lowest height. */
const LOWER_BY_M = 0.002;
const [LOWEST_M] = storedRange('tool_height_m');

export const MEET_THE_MAGNET: Lesson = {
  id: 'magnet',
  title: 'Meet the magnet',
  aim: 'See how a bead follows a magnet that never touches it.',
  minutes: 2,
  question:
    'The magnet hangs 10 cm above the table and moves to the right at 40 mm/s. Where is the bead on the way?',
  choices: [
    { id: 'below', text: 'Right below the magnet' },
    { id: 'behind', text: 'A little behind, 1 to 3 cm' },
    { id: 'edge', text: 'Far behind, where the pull ends' },
  ],
  runs: [
    {
      link: '#v=1&map=open&controller=attractor&seed=1&start=-0.15,-0.36&goal=0.15,-0.36',
      speed: 1,
      layers: ['capture', 'trail'],
      words: [
        'The table is empty, the goal is 30 cm to the right. The blue ring around the tool, the layer Capture, shows how far the pull beats friction.',
        'Let time run and look at e, at the right: the distance from tool to bead.',
      ],
      tasks: [
        TIME_RUNS,
        { text: 'The bead is carried for 10 cm', done: (track) => track.travelled_m > 0.1 },
        DELIVERED,
      ],
      actions: [],
    },
  ],
  outcome: ([track]) => {
    const error_m = track?.carryingError_m ?? 0;
    if (error_m < 0.008) return 'below';
    return error_m < 0.03 ? 'behind' : 'edge';
  },
  facts: ([track]) => [
    ['farthest behind', millimetres(track?.carryingError_m ?? 0)],
    ['delivered', deliveryWords(track)],
  ],
  why: [
    'Right below the magnet nothing pulls sideways: the pull grows with the offset, to 0.31 of the bead’s weight at 4 cm, and fades again.',
    'The bead slides at the offset where the pull equals friction and drag together: about 16 mm at 40 mm/s. When the magnet stops, friction alone is left and it creeps nearer, to 4 mm.',
    'No offset pulls hard enough for more than 79 mm/s: a faster magnet would leave it behind.',
  ],
  paper: 'Section V: the magnets and the plane 10 cm above the table.',
};

export const LIFT_OFF: Lesson = {
  id: 'lift-off',
  title: 'Lift-off',
  aim: 'Find out why the magnet has to stay 10 cm up.',
  minutes: 3,
  question:
    'With its lower face at 100 mm the magnet lifts 0.81 of the bead’s weight. You lower it. When does the bead jump?',
  choices: [
    { id: 'soon', text: 'Soon: some 5 mm lower' },
    { id: 'half', text: 'At about half the height' },
    { id: 'touch', text: 'Only when the two nearly touch' },
  ],
  runs: [
    {
      title: 'Flat, as in the paper',
      link: '#v=1&map=open&controller=attractor&seed=1&start=0,-0.36',
      speed: 1,
      layers: ['capture'],
      words: [
        'There is no goal; the tool stands above the bead. Let time run and lower the magnet step by step.',
        'Look at lift / weight, at the right: at 1 nothing is left of the weight.',
      ],
      tasks: [
        TIME_RUNS,
        { text: 'The magnet lifts 0.9 of the weight', done: (track) => track.greatestLift > 0.9 },
        { text: 'The bead has jumped', done: (track) => track.liftedAt_m !== undefined },
      ],
      actions: [
        {
          label: 'Lower by 2 mm',
          message: ({ parameters }) => ({
            type: 'configure',
            parameters: {
              ...parameters,
              tool_height_m: Math.max(
                LOWEST_M,
                Number((parameters.tool_height_m - LOWER_BY_M).toFixed(4)),
              ),
            },
          }),
        },
      ],
    },
    {
      title: 'On edge',
      link: '#v=1&map=open&controller=attractor&seed=1&start=0,-0.36&block_orientation=B&tool_height_m=0.09',
      speed: 1,
      layers: ['capture'],
      words: [
        'The same magnet turned on its edge, at 90 mm: lower than where the bead has just jumped.',
      ],
      tasks: [
        TIME_RUNS,
        {
          text: 'The bead has stayed on the table for 2 s',
          done: (track) => track.time_s > 2 && track.liftedAt_m === undefined,
        },
      ],
      actions: [],
    },
  ],
  outcome: ([flat]) => {
    const height_m = flat?.liftedAt_m ?? 0;
    if (height_m > 0.08) return 'soon';
    return height_m > 0.03 ? 'half' : 'touch';
  },
  facts: ([flat, edge]) => [
    ['jumped with the magnet at', flat?.liftedAt_m ? millimetres(flat.liftedAt_m, 1) : '–'],
    ['lift / weight on edge, at 90 mm', edge ? fixed(edge.greatestLift, 2) : '–'],
  ],
  why: [
    'The lift grows steeply: 0.81 of the weight at 100 mm, 0.90 at 97 mm, and all of it at 94.4 mm. From there on the bead rises, the pull grows further, and it hits the magnet.',
    'Ten centimetres are a compromise: higher, the sideways pull is soon too weak to beat friction; lower, the bead is gone.',
    'On edge (B) the block’s field at the bead is weaker. It would lift the bead only with its lower face at 74 mm; but to the side it hardly pulls any more, as the layer Capture shows: two patches are left of the ring.',
  ],
  paper: `Section V: the arm moves in a plane ${centimetres(0.1, 0)} above the table.`,
};

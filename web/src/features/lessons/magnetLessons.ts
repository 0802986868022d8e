// Lessons about the magnet: how the bead follows it, and when the bead jumps to it.

import { centimetres, fixed, millimetres } from '../../ui/format';
import { FACTS } from './facts.gen';
import { storedRange } from '../../lab/parameters';
import { DELIVERED, deliveryWords, type ExperimentLesson } from './lesson';

/** Step by which the lesson lowers the magnet, and the lowest height. */
const LOWER_BY_M = 0.002;
const [MIN_HEIGHT_M] = storedRange('tool_height_m');

export const MEET_THE_MAGNET: ExperimentLesson = {
  id: 'magnet',
  title: 'Meet the magnet',
  aim: 'See how a bead follows a magnet that never touches it.',
  minutes: 2,
  question: `The magnet hangs ${millimetres(FACTS.height_m)} above the table and moves to the right at ${millimetres(FACTS.transport_speed_m_s)}/s. Where is the bead while the magnet moves?`,
  choices: {
    below: 'Right below the magnet',
    behind: 'A little behind, 1 to 3 cm',
    edge: 'Far behind, where the pull ends',
  },
  runs: [
    {
      link: '#v=1&map=open&controller=attractor&seed=1&start=-0.15,-0.36&goal=0.15,-0.36',
      layers: ['capture', 'trail'],
      words: [
        '*Set it up* loads an empty table with the goal 30 cm to the right, and lets *Attractor* steer: it heads straight for the goal.',
        'It also switches on the layer *Capture*: inside the blue ring around the tool, the magnet’s pull is stronger than friction.',
        'Press *Run* and look at e below: the distance between the tool and the tracked bead. The tracker’s noise is 1 or 2 mm.',
      ],
      tasks: [
        { text: 'The bead is carried for 10 cm', done: (track) => track.travelled_m > 0.1 },
        DELIVERED,
      ],
    },
  ],
  outcome: ({ carryingError_m }) => {
    if (carryingError_m < 0.008) return 'below';
    return carryingError_m < 0.03 ? 'behind' : 'edge';
  },
  facts: (track) => [
    [
      'greatest distance behind, without the noise of the tracker',
      centimetres(track.carryingError_m),
    ],
    ['delivered', deliveryWords(track)],
  ],
  why: [
    `Right below the magnet there is no sideways pull. The pull grows with the distance to the side, up to ${fixed(FACTS.strongest_pull, 2)} of the bead’s weight at ${centimetres(FACTS.strongest_at_m)}. Farther out it becomes weaker again.`,
    `The moving bead stays at the distance where the pull equals friction plus drag: at ${millimetres(FACTS.transport_speed_m_s)}/s, the distance that your run has measured. When the magnet stops, there is no drag, and the bead slides to ${centimetres(FACTS.rests_at_m)} from the magnet.`,
    `Even the strongest pull cannot move the bead faster than ${millimetres(FACTS.greatest_speed_m_s)}/s. A faster magnet would leave it behind.`,
  ],
  paper: `Section V: the magnets, and the plane ${millimetres(FACTS.height_m)} above the table.`,
};

export const LIFT_OFF: ExperimentLesson = {
  id: 'lift-off',
  title: 'Lift-off',
  aim: `Find out why the magnet has to stay ${millimetres(FACTS.height_m)} above the table.`,
  minutes: 3,
  question: `With its lower face ${millimetres(FACTS.height_m)} above the table, the magnet lifts ${fixed(FACTS.lift, 2)} of the bead’s weight. You lower the magnet. When does the bead jump up to it?`,
  choices: {
    soon: `Soon: about ${millimetres(FACTS.height_m - FACTS.lift_off_m)} lower`,
    half: 'At about half the height',
    touch: 'Only when the magnet almost touches the bead',
  },
  runs: [
    {
      title: 'Flat, as in the paper',
      link: '#v=1&map=open&controller=attractor&seed=1&start=0,-0.36',
      layers: ['capture'],
      words: [
        '*Set it up* places the tool above the bead, without a goal. Press *Run* and lower the magnet step by step.',
        'Look at lift / weight below.',
      ],
      tasks: [
        {
          text: 'The magnet lifts 0.9 of the bead’s weight',
          done: (track) => track.greatestLift > 0.9,
        },
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
                MIN_HEIGHT_M,
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
      layers: ['capture'],
      words: [
        'The same magnet, turned on its edge, 90 mm above the table. That is lower than the height at which the bead jumped before.',
      ],
      tasks: [
        {
          text: 'The bead stays on the table for 2 s',
          done: (track) => track.time_s > 2 && track.liftedAt_m === undefined,
        },
      ],
    },
  ],
  outcome: ({ liftedAt_m = 0 }) => {
    if (liftedAt_m > 0.08) return 'soon';
    return liftedAt_m > 0.03 ? 'half' : 'touch';
  },
  facts: (flat, edge) => [
    ['magnet height when the bead jumped', flat.liftedAt_m ? millimetres(flat.liftedAt_m, 1) : '–'],
    ['lift / weight on edge at 90 mm', fixed(edge.greatestLift, 2)],
  ],
  why: [
    `The lift grows fast as the magnet comes down: ${fixed(FACTS.lift, 2)} of the weight at ${millimetres(FACTS.height_m)}, 0.90 at ${millimetres(FACTS.nine_tenths_at_m)}, and the whole weight at ${millimetres(FACTS.lift_off_m, 1)}. There the bead rises. The pull grows as it rises, so the bead hits the magnet.`,
    `A height of ${millimetres(FACTS.height_m)} is a compromise. If the magnet is higher, its sideways pull soon becomes weaker than friction. If it is lower, the bead jumps to it.`,
    `On its edge (B), the magnet has a weaker field at the bead. It would lift the bead only at a height of ${millimetres(FACTS.lift_off_on_edge_m)}. But its sideways pull is also much weaker: in the layer *Capture*, only two small areas are left of the ring.`,
  ],
  paper: `Section V: the arm moves in a plane ${millimetres(FACTS.height_m)} above the table.`,
};

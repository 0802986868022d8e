// Lessons about the three transports, and how each one treats walls.

import { centimetres, seconds } from '../../ui/format';
import { DELIVERED, deliveryWords, type ExperimentLesson, isDelivered, isSlower } from './lesson';
import { deliveriesTo, type Delivery, type Track } from './track';

const FACE = '#v=1&map=posts&controller=attractor&seed=1&start=-0.05,-0.3&goal=0.13,-0.3';
const THERE = 'seed=1&start=0.19,-0.28&goal=-0.19,-0.48';
/** A moving tool leaves its place within a second; after this time it is stuck. */
const STUCK_S = 8;

export const ATTRACTOR: ExperimentLesson = {
  id: 'attractor',
  title: 'Why the attractor gets stuck',
  aim: 'See a wall that one attractor law cannot pass, and a law that can.',
  minutes: 3,
  question:
    'Attractor dynamics pull the tool straight toward the goal, and bend this motion around each wall in view. The goal is right behind the middle of a flat wall. Where does the paper’s law move the tool?',
  choices: {
    around: 'Around the wall, on either side',
    stuck: 'Up to the wall, and it stays there',
    through: 'Through the wall, with the bead',
  },
  runs: [
    {
      title: 'The paper’s law',
      link: `${FACE}&attractor_law=literal`,
      speed: 2,
      layers: ['flow', 'sensed'],
      words: [
        '*Set it up* switches on the layer *Attractor flow*. Its arrows show where the law leads from each place that the camera has seen.',
        'Press *Run* and wait until the tool stays in one place.',
      ],
      tasks: [
        {
          text: `The tool stays in one place for ${STUCK_S} s`,
          done: (track) => track.lingered_s > STUCK_S,
        },
      ],
    },
    {
      title: 'The improved law',
      link: FACE,
      speed: 2,
      layers: ['flow', 'sensed'],
      words: ['The same wall and the same goal, now with Ferry’s improved law.'],
      tasks: [DELIVERED],
    },
  ],
  outcome: (literal) => {
    if (isDelivered(literal)) return 'around';
    return literal.lingered_s > STUCK_S ? 'stuck' : 'through';
  },
  facts: (literal, improved) => [
    ['paper’s law: time in one place', seconds(literal.lingered_s)],
    ['left to the goal', centimetres(literal.goalDistance_m ?? 0)],
    ['improved law: delivered', deliveryWords(improved)],
  ],
  why: [
    'The law removes the part of the motion that leads into the wall. In front of the middle of a flat wall, the whole pull toward the goal points into the wall, so no motion is left. A little to the side, the flow leads back to the middle.',
    'Where no motion is left, the improved law follows the contour of the wall. It bends the flow around the centre of the wall, not around its face.',
    'The improved law still uses only nearby walls, so it does not reach every goal between the folds of the colon.',
  ],
  paper:
    'Section IV-B, equation 4. Section IV-D says that the law is globally stable; this wall shows that it is not.',
};

/** The start of the run, as the goal of the way back. */
const BACK_M = [0.19, -0.28] as const;

/** The delivery to the goal, and the plans from there to that to the start. */
function wayBack(track: Track): { readonly there: Delivery; readonly again: number } | undefined {
  const [there] = deliveriesTo(track);
  const back = deliveriesTo(track, BACK_M).find(({ time_s }) => there && time_s > there.time_s);
  return there && back && { there, again: back.plans - there.plans };
}

export const ERRT: ExperimentLesson = {
  id: 'errt',
  title: 'What ERRT remembers',
  aim: 'Watch a planner learn the map from the camera images.',
  minutes: 4,
  question:
    'ERRT treats areas that the camera has not shown as free. When the camera shows a wall across its path, ERRT plans again. After the delivery you send the bead back to its start. How often does ERRT plan on the way back?',
  choices: {
    same: 'About as often as on the way to the goal',
    once: 'Once',
    never: 'Never: it follows the old path in reverse',
  },
  runs: [
    {
      link: `#v=1&map=colon&controller=errt&${THERE}`,
      nextGoal_m: BACK_M,
      speed: 4,
      layers: ['plan', 'obstacles', 'seen'],
      words: [
        '*Set it up* switches on the layers *Plan*, *Obstacles* and *Seen so far*. Gray is the area that the camera has not shown yet. The plan goes straight through it, and changes when a wall appears.',
        'When the bead is delivered, press *Send it back*.',
      ],
      tasks: [
        { text: 'ERRT has planned again five times', done: (track) => track.plans > 5 },
        { text: 'Delivered to the goal', done: isDelivered },
        { text: 'Delivered back to the start', done: (track) => wayBack(track) !== undefined },
      ],
      actions: [
        {
          label: 'Send it back',
          message: () => ({ type: 'set_goal', x_m: BACK_M[0], y_m: BACK_M[1] }),
        },
      ],
    },
  ],
  outcome: (track) => {
    const way = wayBack(track);
    if (!way) return 'same';
    if (way.again === 0) return 'never';
    return way.again <= Math.max(1, way.there.plans / 4) ? 'once' : 'same';
  },
  facts: (track) => {
    const way = wayBack(track);
    return [
      ['plans on the way to the goal', way ? String(way.there.plans) : '–'],
      ['plans on the way back', way ? String(way.again) : '–'],
    ];
  },
  why: [
    'ERRT keeps the walls that the camera has shown in an obstacle map, as few rectangles as possible. On the way to the goal, each new fold can block the plan. On the way back all folds are in the map, so the new goal needs one new plan.',
    'ERRT also keeps waypoints of earlier plans. They help the search: most extensions of its tree aim at one of them.',
    'The attractor and the policy remember nothing: they decide from the present camera image.',
  ],
  paper: 'Section IV-C: the waypoint cache, and obstacles as a minimum number of rectangles.',
};

export const POLICY: ExperimentLesson = {
  id: 'policy',
  title: 'What the policy sees',
  aim: 'Find out what a trained policy uses to find its path.',
  minutes: 4,
  question:
    'The policy gets an image of 20 × 20 cm of the table around the tool, and two positions: of the goal and of the tool. With this input it delivers the bead. Now the camera is moved 3 cm to the side, and its image is not corrected for that, so the same walls appear a little shifted. What happens?',
  choices: {
    same: 'It still delivers the bead',
    longer: 'It delivers the bead on a longer path',
    lost: 'It loses its way and never arrives',
  },
  runs: [
    {
      title: 'As it was trained',
      link: `#v=1&map=colon&controller=rl&${THERE}`,
      speed: 4,
      layers: ['camera', 'trail'],
      words: [
        '*Set it up* shows a dashed square around the tool: this is what the camera sees. The panel *Now* shows its image; press it: it grows, with both channels of the observation. During the run, four bars beside it show the value that the policy gives to each possible step.',
      ],
      tasks: [DELIVERED],
    },
    {
      title: 'The camera moved by 3 cm',
      link: `#v=1&map=colon&controller=rl&${THERE}&camera_offset_x_m=0.03&rl_corrects_image=false`,
      speed: 4,
      layers: ['camera', 'trail'],
      words: [
        '*Set it up* moves the camera and switches *Corrected image* off. Press *Run* and watch how the values of the four steps change.',
      ],
      tasks: [
        {
          text: `Delivered, or the tool stays in one place for ${STUCK_S} s`,
          done: (track) => isDelivered(track) || track.lingered_s > STUCK_S,
        },
      ],
    },
  ],
  outcome: (trained, moved) => {
    if (!isDelivered(moved)) return 'lost';
    return isSlower(moved, trained) ? 'longer' : 'same';
  },
  facts: (trained, moved) => [
    ['as trained: delivered', deliveryWords(trained)],
    [
      'camera moved',
      isDelivered(moved)
        ? `delivered ${deliveryWords(moved)}`
        : `${seconds(moved.lingered_s)} in one place`,
    ],
    ['left to the goal', centimetres(moved.goalDistance_m ?? 0)],
  ],
  why: [
    'The policy was trained with the tool in the middle of the image. At the first fold it gives a step down a low value and goes around the fold. With the moved camera, the fold is no longer in the middle of the image: the same step gets the highest value, and the policy always chooses it.',
    'The shield knows the position of the camera. It refuses that step and takes the next best one, to the left or to the right, so the tool moves to and fro. With the shield off, the arm does not move.',
    'ERRT delivers the bead with the same moved camera, because it calculates the place of each pixel on the table. ERRT uses the geometry; the policy only knows images like those it was trained with. With *Corrected image* on, Ferry moves the image to where it was in training, and the policy delivers the bead too.',
    'This policy also needs the map that it was trained on. On other maps Ferry takes the policy explorer. It remembers what the camera has seen and plans with it, so it needs no training on the map, and a moved camera does not matter to it.',
  ],
  paper:
    'Section IV-A, sub-controller 2: observations of 2 × 84 × 84, four actions, success within 2 cm of the goal.',
};

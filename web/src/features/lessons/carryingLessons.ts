// Three sub-controllers 2: what each knows of the walls.

import { centimetres } from '../../ui/format';
import { DELIVERED, deliveryWords, type Lesson, TIME_RUNS } from './lesson';

const FACE = '#v=1&map=posts&controller=attractor&seed=1&start=-0.05,-0.3&goal=0.13,-0.3';
const THERE = 'seed=1&start=0.19,-0.28&goal=-0.19,-0.48';
/** On its way a tool leaves its place within a second; after this long it will not any more. */
const STUCK_S = 8;

export const ATTRACTOR: Lesson = {
  id: 'attractor',
  title: 'Why the attractor gets stuck',
  aim: 'Meet a wall that an attractor cannot pass, and the law that can.',
  minutes: 3,
  question:
    'Attractor dynamics bend a straight pull toward the goal around each wall in view. The goal lies right behind the middle of a flat wall. Where does the tool go, by the paper’s law?',
  choices: [
    { id: 'around', text: 'Around the wall, either side' },
    { id: 'stuck', text: 'Up to the wall, and there it stays' },
    { id: 'through', text: 'Through the wall, with the bead' },
  ],
  runs: [
    {
      title: 'The paper’s law',
      link: `${FACE}&attractor_law=literal`,
      speed: 2,
      layers: ['flow', 'sensed'],
      words: [
        'The layer Attractor flow is switched on: arrows show where the law leads from each place, as far as the camera has seen.',
        'Let time run until it stays in one place.',
      ],
      tasks: [
        TIME_RUNS,
        { text: `${STUCK_S} s in one place`, done: (track) => track.lingered_s > STUCK_S },
      ],
      actions: [],
    },
    {
      title: 'The improved law',
      link: FACE,
      speed: 2,
      layers: ['flow', 'sensed'],
      words: ['Same wall, same goal, Ferry’s improved law.'],
      tasks: [TIME_RUNS, DELIVERED],
      actions: [],
    },
  ],
  outcome: ([literal]) => {
    if (literal && literal.deliveries.length > 0) return 'around';
    return (literal?.lingered_s ?? 0) > STUCK_S ? 'stuck' : 'through';
  },
  facts: ([literal, improved]) => [
    ['paper’s law: in one place', `${(literal?.lingered_s ?? 0).toFixed(1)} s`],
    ['left to the goal', centimetres(literal?.goalDistance_m ?? 0)],
    ['improved law: delivered', deliveryWords(improved)],
  ],
  why: [
    'The modulation takes away the part of the motion that leads into the wall. In front of the middle of a flat face the pull toward the goal is nothing but that part, so nothing is left; and beside it, the flow leads back to the middle. The face’s middle attracts: eight other starts, up to 2.5 cm to either side, end in the same place.',
    'The improved law follows the wall’s contour where nothing else is left, and bends the flow around the wall’s centre, not its face.',
    'It is still local: among the folds of the colon it delivers 87 of 200 random goals, the paper’s law 48.',
  ],
  paper:
    'Section IV-B, equation 4; section IV-D says it is globally stable, which this wall disproves.',
};

export const ERRT: Lesson = {
  id: 'errt',
  title: 'What ERRT remembers',
  aim: 'Watch a planner learn a map from what the camera shows.',
  minutes: 4,
  question:
    'ERRT plans through what it has not seen as if it were free, and plans anew when a wall turns up across its way. Then you send it back where it came from. How often does it plan on the way back?',
  choices: [
    { id: 'same', text: 'About as often as on the way there' },
    { id: 'once', text: 'Once' },
    { id: 'never', text: 'Never: it takes the old way in reverse' },
  ],
  runs: [
    {
      link: `#v=1&map=colon&controller=errt&${THERE}`,
      speed: 4,
      layers: ['plan', 'obstacles', 'seen'],
      words: [
        'The layers Plan, Obstacles and Seen so far are switched on. Gray is unseen: see how the plan goes straight through the unknown, and how it is mended.',
        'When the bead is delivered, send it back.',
      ],
      tasks: [
        TIME_RUNS,
        { text: 'Planned anew five times', done: (track) => track.plans > 5 },
        { text: 'Delivered there', done: (track) => track.deliveries.length > 0 },
        { text: 'Delivered back', done: (track) => track.deliveries.length > 1 },
      ],
      actions: [
        {
          label: 'Send it back',
          message: () => ({ type: 'set_goal', x_m: 0.19, y_m: -0.28 }),
        },
      ],
    },
  ],
  outcome: ([track]) => {
    const [there, back] = track?.deliveries ?? [];
    if (!there || !back) return 'same';
    const again = back.plans - there.plans;
    if (again === 0) return 'never';
    return again <= Math.max(1, there.plans / 4) ? 'once' : 'same';
  },
  facts: ([track]) => {
    const [there, back] = track?.deliveries ?? [];
    return [
      ['plans on the way there', there ? String(there.plans) : '–'],
      ['on the way back', there && back ? String(back.plans - there.plans) : '–'],
    ];
  },
  why: [
    'What the camera has shown is kept in a map, as few rectangles as possible. On the way there each new fold may cut the plan; on the way back all of it is known, and a new goal needs one new plan.',
    'A cache of waypoints from earlier plans helps the search as well: six of ten extensions of its tree aim at one of them.',
    'Neither the attractor nor the policy remembers anything: both decide from the present picture.',
  ],
  paper: 'Section IV-C: the waypoint cache, and obstacles as a minimum number of rectangles.',
};

export const POLICY: Lesson = {
  id: 'policy',
  title: 'What the policy sees',
  aim: 'Find out how a trained policy knows its way.',
  minutes: 4,
  question:
    'The policy sees 20 cm of table around the tool, and two pairs of numbers: the goal’s place and its own. It carries well. Now the camera is moved 3 cm to the side: the same walls, a little shifted in the picture. What happens?',
  choices: [
    { id: 'same', text: 'It delivers all the same' },
    { id: 'longer', text: 'It delivers, by a longer way' },
    { id: 'lost', text: 'It loses its way and never arrives' },
  ],
  runs: [
    {
      title: 'As it was trained',
      link: `#v=1&map=colon&controller=rl&${THERE}`,
      speed: 4,
      layers: ['camera', 'trail'],
      words: [
        'The dashed square around the tool is what the camera sees. At the left is the picture; under it, both channels of the observation. At the right, four fans: what each step is worth to the policy.',
      ],
      tasks: [TIME_RUNS, DELIVERED],
      actions: [],
    },
    {
      title: 'The camera 3 cm aside',
      link: `#v=1&map=colon&controller=rl&${THERE}&camera_offset_x_m=0.03`,
      speed: 4,
      layers: ['camera', 'trail'],
      words: ['Only the camera has moved. Let time run and watch the fans change their mind.'],
      tasks: [
        TIME_RUNS,
        {
          text: `Delivered, or ${STUCK_S} s in one place`,
          done: (track) => track.deliveries.length > 0 || track.lingered_s > STUCK_S,
        },
      ],
      actions: [],
    },
  ],
  outcome: ([trained, moved]) => {
    const [first, second] = [trained?.deliveries[0], moved?.deliveries[0]];
    if (!second) return 'lost';
    return first && second.time_s > 1.25 * first.time_s ? 'longer' : 'same';
  },
  facts: ([trained, moved]) => [
    ['as trained: delivered', deliveryWords(trained)],
    [
      'camera aside',
      moved && moved.deliveries.length > 0
        ? `delivered ${deliveryWords(moved)}`
        : `${(moved?.lingered_s ?? 0).toFixed(1)} s in one place`,
    ],
    ['left to the goal', centimetres(moved?.goalDistance_m ?? 0)],
  ],
  why: [
    'The policy takes the middle of the picture for what is under the tool. At the first fold it gives a step down −0.69 and goes around. With the camera aside the fold has left the middle: the same step is worth 0.99, and it wants nothing else.',
    'The shield knows where the camera sits. It refuses that step and takes the next best, to the left or the right: to and fro. With the shield off, the arm just stands.',
    'ERRT delivers with the same shifted camera: it works out where each pixel lies on the table. It knows the geometry; the policy knows its pictures.',
    'And it knows only those of its maps: of 200 random goals on colon-folds, which it never saw, the policy reaches 18, ERRT 199.',
  ],
  paper:
    'Section IV-A, sub-controller 2: observations of 2 × 84 × 84, four actions, 2 cm to the goal.',
};

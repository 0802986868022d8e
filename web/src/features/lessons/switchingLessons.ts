// Who has the arm: what happens to a lost bead, and how the threshold and the law decide.

import { centimetres } from '../../ui/format';
import { DELIVERED, deliveryWords, type Lesson, type Run, TIME_RUNS } from './lesson';

const KICKED = '#v=1&map=open&controller=attractor&seed=1&start=-0.2,-0.36&goal=0.2,-0.36';
const KICKS =
  'script=impulse:-0.0005,0@step:4;impulse:-0.0005,0@step:10;impulse:-0.0005,0@step:16;impulse:-0.0005,0@step:22';

const POSTS = '#v=1&map=posts&controller=attractor&seed=1&start=-0.25,-0.37&goal=0.24,-0.36';
const SLOW = 'approach_speed_m_s=0.05&script=displace:-0.14,-0.5@step:14';
/** Switches that are no accident any more. */
const MANY = 10;

export const LOSE_THE_BEAD: Lesson = {
  id: 'lose',
  title: 'Lose the bead',
  aim: 'Take the bead away and see how the two sub-controllers share the work.',
  minutes: 3,
  question:
    'The arm carries the bead through the posts. You take it away, 13 cm or more. What does the arm do?',
  choices: [
    { id: 'on', text: 'It carries on to the goal, without the bead' },
    { id: 'waits', text: 'It stops until the bead is back' },
    { id: 'fetches', text: 'It flies to the bead, straight over the walls' },
  ],
  runs: [
    {
      link: POSTS,
      speed: 1,
      layers: ['trail', 'capture'],
      words: [
        'Let time run. When the arm is on its way, drag the bead away with the mouse or a finger, farther than T, and let go. Or let the button do it.',
      ],
      tasks: [
        TIME_RUNS,
        {
          text: 'The bead is more than T = 10 cm away',
          done: (track) => track.greatestError_m > 0.1 || track.losses > 0,
        },
        { text: 'Sub-controller 1 has the arm', done: (track) => track.losses > 0 },
        {
          text: 'Fetched: sub-controller 2 again',
          done: (track) => track.fetchedAt_s !== undefined,
        },
        DELIVERED,
      ],
      actions: [
        {
          label: 'Take it away for me',
          message: () => ({
            type: 'disturb',
            disturbance: { displace: { x_m: -0.14, y_m: -0.5 } },
          }),
        },
      ],
    },
  ],
  outcome: ([track]) => {
    if (track?.fetchedAt_s !== undefined) return 'fetches';
    return track?.stopped ? 'waits' : 'on';
  },
  facts: ([track]) => [
    ['farthest from the tool', centimetres(track?.greatestError_m ?? 0)],
    [
      'fetched within',
      track?.lostAt_s !== undefined && track.fetchedAt_s !== undefined
        ? `${(track.fetchedAt_s - track.lostAt_s).toFixed(1)} s`
        : '–',
    ],
    ['delivered', deliveryWords(track)],
  ],
  why: [
    'Beyond T the law gives the arm to sub-controller 1. It knows the bead’s place from the optical tracker and flies there at up to 250 mm/s; nothing stands as high as the tool, so it looks at no wall.',
    'Once within 1 cm, sub-controller 2 takes over. It uses the camera alone and goes around the walls, for the bead has to follow on the table.',
  ],
  paper: 'Section IV-A: sub-controllers 1 and 2, and the switching signal, equation 1.',
};

function kickedRun(title: string, link: string): Run {
  return {
    title,
    link,
    speed: 1,
    layers: ['trail'],
    words: [
      'Four kicks of 0.5 mN·s against the way, at the steps 4, 10, 16 and 22. Just let time run.',
    ],
    tasks: [TIME_RUNS, { text: 'Four kicks', done: (track) => track.disturbances >= 4 }, DELIVERED],
    actions: [],
  };
}

export const THRESHOLD: Lesson = {
  id: 'threshold',
  title: 'The threshold T',
  aim: 'See what an impatient switching law costs.',
  minutes: 3,
  question:
    'The bead is kicked back four times on its way. First the law waits until it is T = 10 cm away, then only until T = 3 cm. What changes?',
  choices: [
    { id: 'nothing', text: 'Nothing: the kicks are the same' },
    { id: 'sooner', text: 'It is fetched more often and arrives sooner' },
    { id: 'later', text: 'It is fetched more often and arrives later' },
  ],
  runs: [
    kickedRun('T = 10 cm', `${KICKED}&${KICKS}`),
    kickedRun('T = 3 cm', `${KICKED}&threshold_m=0.03&${KICKS}`),
  ],
  outcome: ([wide, narrow]) => {
    if (!wide || !narrow || narrow.losses <= wide.losses) return 'nothing';
    const [first, second] = [wide.deliveries[0], narrow.deliveries[0]];
    return first && second && second.time_s < first.time_s ? 'sooner' : 'later';
  },
  facts: ([wide, narrow]) => [
    ['T = 10 cm: fetched', `${wide?.losses ?? 0} times`],
    ['delivered', deliveryWords(wide)],
    ['T = 3 cm: fetched', `${narrow?.losses ?? 0} times`],
    ['delivered', deliveryWords(narrow)],
  ],
  why: [
    'A kick of 0.5 mN·s sends the bead some 5 cm from the tool. There the pull still beats friction – it does out to 94.5 mm – and brings it back while the arm goes on.',
    'With T = 3 cm the law takes each kick for a loss: the arm turns round, fetches, and starts a new leg.',
    'T is best just inside the reach of the magnet. The paper calls T = 10 cm arbitrary, and yet it is nearly that.',
  ],
  paper: 'Section IV-A, switching signal: “T is an arbitrary threshold set to 10 cm”.',
};

export const TWO_LAWS: Lesson = {
  id: 'chatter',
  title: 'The law to the letter',
  aim: 'See why one threshold for both ways is not enough.',
  minutes: 3,
  question:
    'To the letter, the law is: sub-controller 2 while e ≤ T, else 1. The bead is lifted away, and the tool flies back slowly. What happens when it comes within T = 10 cm?',
  choices: [
    { id: 'carries', text: 'Sub-controller 2 takes over and carries on' },
    { id: 'above', text: 'Sub-controller 1 goes on until it is above the bead' },
    { id: 'turns', text: 'The two take turns, again and again' },
  ],
  runs: [
    {
      title: 'To the letter',
      link: `${POSTS}&switching_law=literal&${SLOW}`,
      speed: 2,
      layers: ['trail'],
      words: [
        'Let time run: after some 3 s the bead is lifted away. Look at the mode at the top and at the diagram at the right.',
      ],
      tasks: [
        TIME_RUNS,
        { text: 'The bead is lost', done: (track) => track.losses > 0 },
        { text: `${MANY} switches`, done: (track) => track.switches >= MANY },
      ],
      actions: [],
    },
    {
      title: 'With hysteresis',
      link: `${POSTS}&${SLOW}`,
      speed: 2,
      layers: ['trail'],
      words: [
        'The same again with Ferry’s default: sub-controller 1 keeps the arm until the bead is within 1 cm.',
      ],
      tasks: [
        TIME_RUNS,
        { text: 'The bead is lost', done: (track) => track.losses > 0 },
        DELIVERED,
      ],
      actions: [],
    },
  ],
  outcome: ([literal]) => {
    if ((literal?.switches ?? 0) >= MANY) return 'turns';
    return literal && literal.deliveries.length > 0 ? 'carries' : 'above';
  },
  facts: ([literal, hysteresis]) => [
    [
      'to the letter',
      `${literal?.switches ?? 0} switches in ${(literal?.time_s ?? 0).toFixed(1)} s`,
    ],
    ['with hysteresis', `${hysteresis?.switches ?? 0} switches`],
    ['delivered', deliveryWords(hysteresis)],
  ],
  why: [
    'At e = T sub-controller 2 gets the arm and steps toward its goal, away from the bead. At 10 cm the pull hardly beats friction, so the bead stays, e exceeds T again, and sub-controller 1 is back.',
    'It looks better when the tool flies fast: at the usual 250 mm/s it is well inside T before the next decision, a quarter of a second later. That is luck and no design.',
    'Two thresholds, 1 cm to have fetched and T to have lost, end it.',
  ],
  paper: 'Section IV-A, equation 1, and the prose below it, which differ at e = T.',
};

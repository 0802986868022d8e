// Lessons about switching: what happens to a lost bead, and how the threshold and the law decide.

import { centimetres, millimetres, seconds } from '../../ui/format';
import { FACTS } from './facts.gen';
import {
  DELIVERED,
  DELIVERED_AFTER_FETCH,
  delivery_s,
  deliveryWords,
  type ExperimentLesson,
  isDelivered,
  type Run,
} from './lesson';
import type { Track } from './track';

const KICKED = '#v=1&map=open&controller=attractor&seed=1&start=-0.2,-0.36&goal=0.2,-0.36';
const KICKS =
  'script=impulse:-0.0005,0@step:4;impulse:-0.0005,0@step:10;impulse:-0.0005,0@step:16;impulse:-0.0005,0@step:22';

const POSTS = '#v=1&map=posts&controller=attractor&seed=1&start=-0.25,-0.37&goal=0.24,-0.36';
const SLOW = 'approach_speed_m_s=0.05&script=displace:-0.14,-0.5@step:14';
/** How long the first fetch took. */
const fetchWords = ({ lostAt_s, fetchedAt_s }: Track): string =>
  lostAt_s === undefined || fetchedAt_s === undefined ? '–' : seconds(fetchedAt_s - lostAt_s);

/** This many switches are no accident. */
const MANY_SWITCHES = 10;

export const LOSE_THE_BEAD: ExperimentLesson = {
  id: 'lose',
  title: 'Lose the bead',
  aim: 'Take the bead away and see how the two sub-controllers share the work.',
  minutes: 3,
  question:
    'The arm carries the bead between the posts. You take the bead away, by 13 cm or more. What does the arm do?',
  choices: {
    on: 'It continues to the goal without the bead',
    waits: 'It stops until the bead is back',
    fetches: 'It flies straight to the bead',
  },
  runs: [
    {
      link: POSTS,
      layers: ['trail', 'capture'],
      words: [
        '*Set it up* lets *Attractor* steer: it heads straight for the goal and bends its way around walls.',
        'Press *Run*. While the arm carries the bead, drag the bead away with the mouse or a finger, farther than T, and release it. Or press the button *Take it away for me*.',
      ],
      tasks: [
        {
          text: 'The bead is more than T = 10 cm away',
          done: (track) => track.greatestError_m > 0.1 || track.losses > 0,
        },
        { text: 'Sub-controller 1 moves the arm', done: (track) => track.losses > 0 },
        {
          text: 'Bead fetched: sub-controller 2 moves the arm again',
          done: (track) => track.fetchedAt_s !== undefined,
        },
        DELIVERED_AFTER_FETCH,
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
  outcome: (track) => {
    if (track.fetchedAt_s !== undefined) return 'fetches';
    return track.stopped ? 'waits' : 'on';
  },
  facts: (track) => [
    ['greatest distance from the tool', centimetres(track.greatestError_m)],
    ['time to fetch it', fetchWords(track)],
    ['delivered', deliveryWords(track)],
  ],
  why: [
    `When the bead is farther away than T, sub-controller 1 moves the arm. It gets the bead’s position from the optical tracker and flies there at up to ${millimetres(FACTS.approach_speed_m_s)}/s. All walls are lower than the tool, so it can fly straight over them.`,
    `When the tool is within ${centimetres(FACTS.fetch_radius_m, 0)} of the bead, sub-controller 2 takes over. It uses only the camera and goes around the walls, because the bead has to follow on the table.`,
  ],
  paper: 'Section IV-A: sub-controllers 1 and 2, and the switching signal, equation 1.',
};

function kickedRun(title: string, link: string): Run {
  return {
    title,
    link,
    layers: ['trail'],
    words: [
      '*Set it up* lets *Attractor* steer: it heads straight for the goal.',
      'Four kicks of 0.5 mN·s push the bead backward, at the steps 4, 10, 16 and 22. Press *Run* and watch.',
    ],
    tasks: [
      { text: 'Four kicks have happened', done: (track) => track.disturbances >= 4 },
      DELIVERED,
    ],
  };
}

export const THRESHOLD: ExperimentLesson = {
  id: 'threshold',
  title: 'The threshold T',
  aim: 'See what a low threshold costs.',
  minutes: 3,
  question:
    'Four kicks push the bead backward, opposing the motion. In the first run the bead counts as lost when it is more than T = 10 cm away, in the second run when it is more than T = 3 cm away. What changes?',
  choices: {
    nothing: 'Nothing: the kicks are the same',
    sooner: 'It is fetched more often and arrives sooner',
    later: 'It is fetched more often and arrives later',
  },
  runs: [
    kickedRun('T = 10 cm', `${KICKED}&${KICKS}`),
    kickedRun('T = 3 cm', `${KICKED}&threshold_m=0.03&${KICKS}`),
  ],
  outcome: (wide, narrow) => {
    if (narrow.losses <= wide.losses) return 'nothing';
    return delivery_s(narrow) < delivery_s(wide) ? 'sooner' : 'later';
  },
  facts: (wide, narrow) => [
    ['T = 10 cm: greatest distance', centimetres(wide.greatestError_m)],
    ['fetched', `${wide.losses} times`],
    ['delivered', deliveryWords(wide)],
    ['T = 3 cm: fetched', `${narrow.losses} times`],
    ['delivered', deliveryWords(narrow)],
  ],
  why: [
    `With T = 10 cm no kick counts as a loss. Up to ${centimetres(FACTS.reach_m)} away, the magnet’s pull is still stronger than friction, and it brings the bead back while the arm continues.`,
    'With T = 3 cm each kick counts as a loss: the arm turns around, fetches the bead, and starts a new leg.',
    'The best T is a little less than the reach of the magnet. The paper calls T = 10 cm arbitrary, but it is close to this value.',
  ],
  paper: 'Section IV-A, switching signal: “T is an arbitrary threshold set to 10 cm”.',
};

export const TWO_LAWS: ExperimentLesson = {
  id: 'chatter',
  title: 'The law to the letter',
  aim: 'See why one threshold for both directions of the switch is not enough.',
  minutes: 3,
  question:
    'The paper’s formula says: sub-controller 2 if e ≤ T, otherwise sub-controller 1. A disturbance moves the bead away, and the tool flies back to it slowly. What happens when the tool comes within T = 10 cm of the bead?',
  choices: {
    carries: 'Sub-controller 2 takes over and carries the bead',
    above: 'Sub-controller 1 continues until the tool is above the bead',
    turns: 'The two take turns, again and again',
  },
  runs: [
    {
      title: 'The formula as written',
      link: `${POSTS}&switching_law=literal&${SLOW}`,
      speed: 2,
      layers: ['trail'],
      words: [
        '*Set it up* lets *Attractor* steer: it heads straight for the goal and bends its way around walls.',
        'Press *Run*. After about 3 s the bead is moved away. Look at the sentence at the top and at e below.',
      ],
      tasks: [
        { text: 'The bead is lost', done: (track) => track.losses > 0 },
        { text: `${MANY_SWITCHES} switches`, done: (track) => track.switches >= MANY_SWITCHES },
      ],
    },
    {
      title: 'With hysteresis',
      link: `${POSTS}&${SLOW}`,
      speed: 2,
      layers: ['trail'],
      words: [
        'The same experiment with Ferry’s default law: sub-controller 1 moves the arm until the tool is within 1 cm of the bead.',
      ],
      tasks: [
        { text: 'The bead is lost', done: (track) => track.losses > 0 },
        DELIVERED_AFTER_FETCH,
      ],
    },
  ],
  outcome: (literal) => {
    if (literal.switches >= MANY_SWITCHES) return 'turns';
    return isDelivered(literal) ? 'carries' : 'above';
  },
  facts: (literal, hysteresis) => [
    ['formula as written', `${literal.switches} switches in ${seconds(literal.time_s)}`],
    ['with hysteresis', `${hysteresis.switches} switches`],
    ['delivered', deliveryWords(hysteresis)],
  ],
  why: [
    'At e = T sub-controller 2 takes over and moves toward the goal, away from the bead. At a distance of 10 cm the pull is too weak to move the bead. So the bead stays, e becomes larger than T again, and sub-controller 1 takes over again.',
    `With a faster tool the problem does not show: at the usual ${millimetres(FACTS.approach_speed_m_s)}/s the tool is well within T at the next decision, a quarter of a second later. That is luck, not design.`,
    `Two thresholds solve the problem: the bead counts as fetched within ${centimetres(FACTS.fetch_radius_m, 0)}, and as lost beyond T.`,
  ],
  paper: 'Section IV-A, equation 1, and the text below it. The two differ at e = T.',
};

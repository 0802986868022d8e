// The robot client, and the robot that the arm mirrors, as words. Pure.

import type {
  ApartFact,
  DoubtFact,
  DriveFact,
  ProtectiveStop,
  RobotStanding,
  TwinStanding,
  TwinTrouble,
} from '../net/protocol.gen';
import { counted, fixed } from '../ui/format';
import { shownName } from '../ui/name';

// Universal Robots' names of the numbers that RTDE reports.
const MODES = new Map([
  [-1, 'no controller'],
  [0, 'disconnected'],
  [1, 'waits for a confirmation of its safety settings'],
  [2, 'booting'],
  [3, 'power off'],
  [4, 'power on'],
  [5, 'idle, brakes on'],
  [6, 'backdrive'],
  [7, 'running'],
]);
const SAFETY = new Map([
  [1, 'normal'],
  [2, 'reduced'],
  [3, 'protective stop'],
  [4, 'recovery'],
  [5, 'safeguard stop'],
  [6, 'emergency stop of the system'],
  [7, 'emergency stop of the robot'],
  [8, 'violation'],
  [9, 'fault'],
]);

const modeName = (mode: number): string => MODES.get(mode) ?? `mode ${String(mode)}`;
const safetyName = (mode: number): string => SAFETY.get(mode) ?? `safety mode ${String(mode)}`;

/** `2 connections from 127.0.0.1: RTDE, URScript`, by the address of the client. */
export function clientsWords({ clients }: RobotStanding): string[] {
  const by = new Map<string, string[]>();
  for (const { from, speech } of clients) {
    const address = from.replace(/:\d+$/, '');
    by.set(address, [...(by.get(address) ?? []), speech]);
  }
  return [...by].map(
    ([address, speeches]) =>
      `${address}: ${counted(speeches.length, 'connection')} (${[...new Set(speeches)].join(', ')})`,
  );
}

const stopWords = (stop: ProtectiveStop): string =>
  stop.code === 'requested' ? 'a program has asked for it' : stop.detail;

/** What moves the simulated arm, which a robot client commands. */
export function clientMotionWords({ program, command, stop }: RobotStanding): string {
  if (stop !== null) return `Protective stop: ${stopWords(stop)}.`;
  if (program === null) return 'No program runs: the arm rests.';
  return command === null
    ? `The program ${shownName(program)} runs; the arm rests.`
    : `The program ${shownName(program)} moves the arm: ${command}.`;
}

const troubleWords = (trouble: TwinTrouble): string =>
  trouble.code === 'not_yet' ? 'not connected yet' : trouble.detail;

/** Whether the robot is there, and in what state. */
export function connectionWords(twin: TwinStanding): string {
  if (twin.trouble !== null)
    return `Robot ${twin.address} is not connected: ${troubleWords(twin.trouble)}.`;
  const model = twin.model === null ? '' : ` (${shownName(twin.model)})`;
  return `Robot ${twin.address}${model}: ${modeName(twin.robot_mode)}, safety: ${safetyName(twin.safety_mode)}.`;
}

const poseWords = (pose: readonly number[]): string =>
  `p[${pose.map((value) => fixed(value, 4)).join(', ')}]`;

const apartWords = ({ reported, computed, distance_m, angle_rad }: ApartFact): string =>
  `${poseWords(reported)} by the robot and ${poseWords(computed)} by Ferry, ` +
  `which are ${fixed(1000 * distance_m, 1)} mm and ${fixed((180 / Math.PI) * angle_rad, 1)}° apart`;

const DOUBTS: Readonly<Record<DoubtFact['code'], string>> = {
  tool: 'either its TCP is not Ferry’s, or it is no UR5: its tool is at',
  flange: 'its calibration differs, and places on the table do as well: its flange is at',
};

/** Why places may be others than the page shows. */
export const doubtWords = (doubt: DoubtFact): string =>
  `Ferry’s places may not be the robot’s: ${DOUBTS[doubt.code]} ${apartWords(doubt)}.`;

function driveWords(fact: DriveFact): string {
  switch (fact.code) {
    case 'not_enabled':
      return 'motion is not enabled; start Ferry with --enable-motion';
    case 'not_connected':
      return 'it is not connected';
    case 'mode':
      return `it must run, and is: ${modeName(fact.robot_mode)}`;
    case 'safety':
      return `its safety must be normal or reduced, and is: ${safetyName(fact.safety_mode)}`;
    case 'busy':
      return 'another program runs on it; stop that first';
    case 'place':
      return `the arm is not where Ferry may move it: ${fact.detail}`;
    case 'other_arm':
      return `it is not a UR5: its flange is at ${apartWords(fact)}`;
    case 'no_arm':
      return 'the map has a planar stage and no arm';
    case 'not_begun':
      return 'it has not begun Ferry’s program in time';
    case 'not_sent':
      return `Ferry’s program could not be sent: ${fact.detail}`;
    case 'silent':
      return 'nothing was heard from it';
    case 'over':
      return 'it has ended Ferry’s program';
    case 'behind':
      return `joint ${fact.joint} is ${fixed(fact.behind_rad, 3)} rad from where it should be`;
    case 'limit':
      return `a limit would be violated: ${fact.detail}`;
    case 'refused':
      return `the session refuses what it reports: ${fact.detail}`;
    case 'changed':
      return 'the session was paused, set back or changed';
    case 'released':
      return 'the button is no longer held';
  }
}

/** Who moves the robot. */
export function robotMotionWords(twin: TwinStanding): string {
  if (!twin.allows_motion) {
    return 'Read only: the arm here is where the robot is. Ferry moves it only when it is started with --enable-motion.';
  }
  if (twin.is_driven) return 'The robot follows Ferry’s controller.';
  if (twin.is_held) return 'The robot begins Ferry’s program…';
  return twin.stopped === null
    ? 'The robot rests, or something else moves it.'
    : `The robot does not follow: ${driveWords(twin.stopped)}.`;
}

// What the page says about the robot that the arm mirrors. Pure.

import type { TwinStanding } from '../../net/protocol.gen';
import { shownName } from '../../ui/name';

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

/** Whether the robot is there, and in what state. */
export function connectionWords(twin: TwinStanding): string {
  if (twin.trouble !== null) return `Robot ${twin.address} is not connected: ${twin.trouble}.`;
  const mode = MODES.get(twin.robot_mode) ?? `mode ${String(twin.robot_mode)}`;
  const safety = SAFETY.get(twin.safety_mode) ?? `safety mode ${String(twin.safety_mode)}`;
  const model = twin.model === null ? '' : ` (${shownName(twin.model)})`;
  return `Robot ${twin.address}${model}: ${mode}, safety: ${safety}.`;
}

/** Why places may be others than the page shows. */
export function doubtWords(doubt: string): string {
  return `Ferry’s places may not be the robot’s: ${doubt}.`;
}

/** Who moves the robot. */
export function motionWords(twin: TwinStanding): string {
  if (!twin.allows_motion) {
    return 'Read only: the arm here is where the robot is. Ferry moves it only when it is started with --enable-motion.';
  }
  if (twin.is_driven) return 'The robot follows Ferry’s controller.';
  if (twin.is_held) return 'The robot begins Ferry’s program…';
  return twin.stopped === null
    ? 'The robot rests, or something else moves it.'
    : `The robot does not follow: ${twin.stopped}.`;
}

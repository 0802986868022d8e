// What the page says about the clients of the robot server. Pure.

import type { RobotStanding } from '../../net/protocol.gen';
import { counted } from '../../ui/format';
import { shownName } from '../../ui/name';

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

/** What moves the arm now. */
export function motionWords({ program, command, stop }: RobotStanding): string {
  if (stop !== null) return `Protective stop: ${stop}.`;
  if (program === null) return 'No program runs: the arm rests.';
  return command === null
    ? `The program ${shownName(program)} runs; the arm rests.`
    : `The program ${shownName(program)} moves the arm: ${command}.`;
}

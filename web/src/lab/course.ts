// The course of the trial: from the states, and from the server's own record what this page has not seen.

import { CONTROLLER_LABELS, type ControllerName, type StateMessage } from '../net/protocol.gen';
import { CARRIERS } from '../ui/controllers';
import type { History, Sample } from './history';
import type { Input } from './model';

/** Tick of the first point and ticks between two, before the points. */
const HEAD_BYTES = 8;
/** Four positions as numbers of 32 bits, then two bytes. */
const POINT_BYTES = 18;
/** A point has the number of its controller in this order. */
const CONTROLLERS = Object.keys(CONTROLLER_LABELS) as readonly ControllerName[];

/** The points of a part; the route of the WebSocket describes its format. */
export function pointsOf(bytes: Uint8Array<ArrayBuffer>, tick_s: number): Sample[] {
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  const [step, first] = [view.getUint32(0, true), view.getUint32(4, true)];
  const count = Math.floor((bytes.byteLength - HEAD_BYTES) / POINT_BYTES);
  return Array.from({ length: count }, (_, index): Sample => {
    const position = (column: number): number =>
      view.getFloat32(HEAD_BYTES + 4 * (column * count + index), true);
    const byte = (column: number): number =>
      view.getUint8(HEAD_BYTES + (16 + column) * count + index);
    const tick = first + step * index;
    const [tool_x_m, tool_y_m, bead_x_m, bead_y_m] = [0, 1, 2, 3].map(position) as [
      number,
      number,
      number,
      number,
    ];
    const [error_x_m, error_y_m] = [tool_x_m - bead_x_m, tool_y_m - bead_y_m];
    return {
      tick,
      sim_time_s: tick * tick_s,
      tool_x_m,
      tool_y_m,
      bead_x_m,
      bead_y_m,
      error_x_m,
      error_y_m,
      error_m: Math.hypot(error_x_m, error_y_m),
      mode: byte(0),
      controller: CARRIERS.indexOf(CONTROLLERS[byte(1)] ?? 'program'),
    };
  });
}

/** Returns what puts the course into the history, with the states that are never shown. */
export function createRecorder(history: History): (input: Input) => void {
  let trial: number | undefined;
  let tick_s = 0;
  let newest_tick = 0;
  const record = (state: StateMessage): void => {
    // Down to the moment itself, which a reset may have changed.
    if (state.newest_tick < newest_tick) history.cutAfter(state.newest_tick - 1);
    ({ newest_tick } = state);
    history.push(state);
  };
  return (input) => {
    if (input.type === 'passed') record(input.state);
    else if (input.type === 'course') {
      const { tick, bytes } = input.part;
      history.cutAfter(tick - 1);
      for (const point of pointsOf(bytes, tick_s)) history.add(point);
    } else if (input.type === 'message') {
      const { message } = input;
      if (message.type === 'state') record(message);
      else if (message.type === 'event') {
        const { code } = message.what;
        if (code === 'displaced' || code === 'placed') history.addJump(message.tick);
      } else if (message.type === 'scene') {
        if (trial !== undefined && trial !== message.trial) history.clear();
        ({ trial, tick_s } = message);
      }
    }
  };
}

// The panel at which a message appears.

import type { ClientMessage, ErrorMessage } from '../net/protocol.gen';
import type { Model } from './model';

/** Panels at which a message can appear. */
export type Place = 'workspace' | 'controller' | 'playback' | 'session' | 'compare' | 'recovery';

export const PLACE_OF_COMMAND: Record<ClientMessage['type'], Place> = {
  set_goal: 'workspace',
  clear_goal: 'workspace',
  drag: 'workspace',
  release: 'workspace',
  disturb: 'workspace',
  steer: 'workspace',
  select_controller: 'controller',
  drive_robot: 'controller',
  configure: 'controller',
  run: 'playback',
  pause: 'playback',
  step: 'playback',
  set_speed: 'playback',
  reset: 'playback',
  load_scenario: 'playback',
  open_case: 'playback',
  open_try: 'recovery',
  play_challenge: 'playback',
  rewind: 'playback',
  return_to: 'playback',
  fork: 'compare',
  take_control: 'session',
  release_control: 'session',
};

const PLACE_OF_FIELD: Partial<Record<string, Place>> = {
  goal: 'workspace',
  goal_m: 'workspace',
  drag: 'workspace',
  x_m: 'workspace',
  y_m: 'workspace',
  controller: 'controller',
  map: 'playback',
  seed: 'playback',
  factor: 'playback',
  tick: 'playback',
  ticks: 'playback',
  run: 'playback',
};

/** Error code: the server released the bead because it received nothing from the hand. */
export const HAND_SILENT = 'hand_silent';

const PLACE_OF_CODE: Partial<Record<string, Place>> = {
  stale_epoch: 'session',
  [HAND_SILENT]: 'workspace',
};

/** The place of a refusal on the page: from its code or field, otherwise from the last command. */
export function placeOfError(
  error: ErrorMessage,
  { lastCommand, scene }: Pick<Model, 'lastCommand' | 'scene'>,
): Place {
  const place = PLACE_OF_CODE[error.code];
  if (place) return place;
  // Their refusals name fields of other commands.
  if (lastCommand === 'fork' || lastCommand === 'open_case' || lastCommand === 'open_try') {
    return PLACE_OF_COMMAND[lastCommand];
  }
  const field = error.field?.split('.').at(-1);
  if (field !== undefined) {
    if (scene && Object.hasOwn(scene.parameters, field)) return 'controller';
    const place = PLACE_OF_FIELD[field];
    if (place) return place;
  }
  return lastCommand ? PLACE_OF_COMMAND[lastCommand] : 'session';
}

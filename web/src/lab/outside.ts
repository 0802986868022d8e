// Whether something outside of Ferry moves the arm.

import type { StateMessage } from '../net/protocol.gen';

/** A robot client has the arm, or the arm mirrors a robot that does not follow: no sub-controller is active. */
export const isLedFromOutside = ({
  controller,
  twin,
}: Pick<StateMessage, 'controller' | 'twin'>): boolean =>
  controller === 'robot' || (twin !== null && !twin.is_driven);

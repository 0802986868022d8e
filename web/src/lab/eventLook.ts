// How an event looks in the story and on the time line: an icon, and a colour of the style sheet.

import {
  ArrowLeftRight,
  ArrowUpFromLine,
  Ban,
  Check,
  Crosshair,
  Flag,
  Hand,
  Magnet,
  OctagonX,
  Settings2,
  type IconNode,
} from 'lucide';
import type { EventKind, EventMessage } from '../net/protocol.gen';

export interface EventLook {
  readonly icon: IconNode;
  readonly colour: string;
}

const LOOKS: Readonly<Record<EventKind, EventLook>> = {
  switch: { icon: ArrowLeftRight, colour: 'ink-2' },
  disturbance: { icon: Hand, colour: 'you' },
  goal: { icon: Flag, colour: 'goal' },
  reached: { icon: Crosshair, colour: 'goal' },
  delivered: { icon: Check, colour: 'goal' },
  lift_off: { icon: ArrowUpFromLine, colour: 'danger' },
  refused: { icon: Ban, colour: 'danger' },
  stopped: { icon: OctagonX, colour: 'danger' },
  session: { icon: Settings2, colour: 'ink-3' },
};

export function eventLook({ kind, what }: Pick<EventMessage, 'kind' | 'what'>): EventLook {
  const isFetch = what.code === 'took_over' && what.sub_controller === 1;
  return isFetch ? { ...LOOKS[kind], icon: Magnet } : LOOKS[kind];
}

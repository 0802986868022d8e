// The tools: what each does, and what can be set for it.

import {
  Circle,
  CircleDot,
  Flag,
  Hand,
  type IconNode,
  Route,
  SquareDashedMousePointer,
  X,
} from 'lucide';
import type { Brush, Tool } from './editing';

/** Id of the text that describes the tool. */
export const HELP_ID = 'draw-help';

interface About {
  readonly tool: Tool;
  readonly name: string;
  readonly icon: IconNode;
  readonly help: string;
  /** Its size, and what that is called. */
  readonly brush?: readonly [Brush, string];
}

export const TOOLS: readonly About[] = [
  {
    tool: 'wall',
    name: 'Wall',
    icon: Route,
    help: 'Drag to draw by hand. Click for a corner; click it again to finish.',
    brush: ['wall', 'Width'],
  },
  {
    tool: 'post',
    name: 'Post',
    icon: Circle,
    help: 'Click to put a post. Drag from its middle for another size.',
    brush: ['post', 'Diameter'],
  },
  {
    tool: 'area',
    name: 'Area',
    icon: SquareDashedMousePointer,
    help: 'Drag a rectangle. Click for a corner; click the first one to finish.',
  },
  {
    tool: 'erase',
    name: 'Erase',
    icon: X,
    help: 'Drag over walls to cut them away.',
    brush: ['erase', 'Width'],
  },
  {
    tool: 'move',
    name: 'Move',
    icon: Hand,
    help: 'Click a shape to select it. Drag it to another place.',
  },
  {
    tool: 'start',
    name: 'Start',
    icon: CircleDot,
    help: 'Click where the bead starts. Click it again to remove it: then the seed chooses the place.',
  },
  {
    tool: 'goal',
    name: 'Goal',
    icon: Flag,
    help: 'Click where the bead is to be carried. Click it again to remove it: then it is far from the start.',
  },
];

const aboutOf = (tool: Tool): About | undefined => TOOLS.find((one) => one.tool === tool);

export const helpOf = (tool: Tool): string => aboutOf(tool)?.help ?? '';
export const brushOf = (tool: Tool): About['brush'] => aboutOf(tool)?.brush;

// What the keys do all over the page, and what those of the workspace do there.

import type { Lab } from '../lab/lab';
import type { Shortcut } from '../ui/shortcuts';
import { nextSpeed, ticksToControlStep } from '../features/playback/steps';

const CONTROLLERS = ['rl', 'errt', 'attractor'] as const;

/** Heard by the workspace itself. */
const WORKSPACE: readonly Shortcut[] = [
  {
    group: 'Workspace',
    keys: ['ArrowLeft', 'ArrowUp', 'ArrowRight', 'ArrowDown'],
    does: 'move the cursor, or the bead in the hand; with Shift over walls',
  },
  { group: 'Workspace', keys: ['Enter'], does: 'place the goal, or what is picked, at the cursor' },
  { group: 'Workspace', keys: ['d'], does: 'take the bead, let it go' },
  { group: 'Workspace', keys: ['Escape'], does: 'let the bead go, end picking' },
];

/** `isShown` tells whether the laboratory is in view: nobody changes what he does not see. */
export function pageShortcuts(
  lab: Lab,
  isShown: () => boolean,
  help: () => void,
): readonly Shortcut[] {
  /** Nothing of a viewer's, and nothing before there is a state. */
  const operate = (act: () => void) => () => {
    if (isShown() && lab.canOperate() && lab.state()) act();
  };
  const shiftSpeed = (direction: 1 | -1) =>
    operate(() => {
      const target = lab.state()?.speed_target ?? 1;
      const factor = nextSpeed(target, direction);
      if (factor !== target) lab.send({ type: 'set_speed', factor });
    });
  const step = (ticks: () => number) =>
    operate(() => {
      if (!lab.state()?.running) lab.send({ type: 'step', ticks: ticks() });
    });
  return [
    {
      group: 'Time',
      keys: [' '],
      does: 'run or pause',
      run: operate(() => {
        lab.send({ type: lab.state()?.running ? 'pause' : 'run' });
      }),
    },
    { group: 'Time', keys: ['.'], does: 'one tick of 8 ms', run: step(() => 1) },
    {
      group: 'Time',
      keys: [','],
      does: 'to the next control step',
      run: step(() => ticksToControlStep(lab.state()?.tick ?? 0, lab.scene()?.tick_s ?? 0.008)),
    },
    { group: 'Time', keys: ['[', '-'], does: 'slower', run: shiftSpeed(-1) },
    { group: 'Time', keys: [']', '+'], does: 'faster', run: shiftSpeed(1) },
    {
      group: 'Time',
      keys: ['r'],
      does: 'reset, with the same seed',
      run: operate(() => {
        lab.send({ type: 'reset' });
      }),
    },
    ...CONTROLLERS.map((controller, index) => ({
      group: 'Controller',
      keys: [String(index + 1)],
      does: { rl: 'RL', errt: 'ERRT', attractor: 'Attractor' }[controller],
      run: operate(() => {
        if (lab.scene()?.controllers.includes(controller)) {
          lab.send({ type: 'select_controller', controller });
        }
      }),
    })),
    {
      group: 'Page',
      keys: ['g'],
      does: 'to the workspace, to place a goal',
      run: () => document.querySelector<HTMLElement>('.stage-canvas')?.focus(),
    },
    { group: 'Page', keys: ['?'], does: 'this help', run: help },
    ...WORKSPACE,
  ];
}

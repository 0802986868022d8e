import { toggleLanes } from '../../lab/lanes';
import type { FeatureShortcuts } from '../../lab/shortcuts';
import { nextSpeed, ticksToControlStep } from './steps';
import { hintAtGoal, runOrPause } from './run';
import type { Addressed, Notices, Panels, Session, Trial } from '../../lab/slices';

export const TIME_SHORTCUTS: FeatureShortcuts<Session & Trial & Notices & Addressed & Panels> = (
  lab,
  operate,
) => {
  const shiftSpeed = (direction: 1 | -1) =>
    operate(() => {
      const target = lab.state()?.speed_target ?? 1;
      const factor = nextSpeed(target, direction);
      if (factor !== target) void lab.send('playback', { type: 'set_speed', factor });
    });
  const step = (ticks: () => number) =>
    operate(() => {
      if (!lab.state()?.running) void lab.send('playback', { type: 'step', ticks: ticks() });
    });
  return [
    {
      group: 'Time',
      keys: [' '],
      does: 'run or pause',
      run: operate(() => {
        void lab.send('playback', runOrPause(lab)).then(() => {
          hintAtGoal(lab);
        });
      }),
    },
    { group: 'Time', keys: ['.'], does: 'step by one tick of 8 ms', run: step(() => 1) },
    {
      group: 'Time',
      keys: [','],
      does: 'go to the next control step',
      run: step(() => ticksToControlStep(lab.state()?.tick ?? 0, lab.scene()?.tick_s ?? 0.008)),
    },
    { group: 'Time', keys: ['[', '-'], does: 'slower', run: shiftSpeed(-1) },
    { group: 'Time', keys: [']', '+'], does: 'faster', run: shiftSpeed(1) },
    {
      group: 'Time',
      keys: ['r'],
      does: 'reset with the same seed',
      run: operate(() => {
        void lab.send('playback', { type: 'reset' });
      }),
    },
    {
      group: 'Time',
      keys: ['p'],
      does: 'show or hide the plots',
      // Viewers may look at them, too.
      run: () => {
        if (lab.address.view() === 'laboratory') toggleLanes();
      },
    },
    { group: 'Workspace', keys: ['f'], does: 'let the map fill its place', run: lab.toggleFill },
  ];
};

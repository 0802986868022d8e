// Run, step, reset and speed.

import { createMemo, type JSX } from 'solid-js';
import { ChevronDown, Pause, Play, RotateCcw, StepForward } from 'lucide';
import { CommandButton } from '../../lab/CommandButton';
import type { Notices, Session, Trial } from '../../lab/slices';
import { Icon } from '../../ui/Icon';
import { ServerSelect } from '../../ui/ServerSelect';
import { Achieved } from './Achieved';
import { hintAtGoal, runOrPause } from './run';
import { speedName, SPEEDS, ticksToControlStep } from './steps';
import './Transport.css';

export function Transport(props: {
  lab: Session & Trial & Notices;
  /** On a phone, where the dock has Run only: all the others. */
  inMenu?: boolean;
}): JSX.Element {
  const { lab } = props;
  const running = (): boolean => lab.state()?.running ?? false;
  // A memo, so that other updates do not recreate the list under the pointer.
  const target = createMemo(() => lab.state()?.speed_target ?? 1);
  const speeds = createMemo(() => {
    const all = [...new Set([...SPEEDS, target()])].sort((a, b) => a - b);
    return all.map((factor) => [String(factor), speedName(factor)] as const);
  });
  const controlStep = (): number =>
    ticksToControlStep(lab.state()?.tick ?? 0, lab.scene()?.tick_s ?? 0.008);
  return (
    <div class="run-buttons" classList={{ 'in-menu': props.inMenu ?? false }}>
      <CommandButton
        lab={lab}
        at="playback"
        class="primary run"
        aria-label={running() ? 'Pause' : 'Run'}
        title="Space"
        command={() => runOrPause(lab)}
        onDone={() => {
          hintAtGoal(lab);
        }}
      >
        <Icon of={running() ? Pause : Play} />
        <span>{running() ? 'Pause' : 'Run'}</span>
      </CommandButton>
      <CommandButton
        lab={lab}
        at="playback"
        class="ghost icon-only"
        aria-label="Step"
        disabled={running()}
        title="One tick of 8 ms (.); with Shift one control step, a quarter of a second (,)"
        command={({ shiftKey }) => {
          return { type: 'step', ticks: shiftKey ? controlStep() : 1 };
        }}
      >
        <Icon of={StepForward} />
      </CommandButton>
      {/* For fingers, which have no Shift. */}
      <CommandButton
        lab={lab}
        at="playback"
        class="ghost quarter"
        aria-label="Step ¼ s"
        disabled={running()}
        command={() => ({ type: 'step', ticks: controlStep() })}
      >
        ¼ s
      </CommandButton>
      <CommandButton
        lab={lab}
        at="playback"
        class="ghost icon-only"
        aria-label="Reset"
        title="Back to the start with the same seed (R)"
        command={() => ({ type: 'reset' })}
      >
        <Icon of={RotateCcw} />
      </CommandButton>
      <div class="speed">
        <ServerSelect
          label="Speed"
          hideLabel
          value={String(target())}
          options={speeds()}
          disabled={!lab.canOperate()}
          onChoose={(value) => lab.send('playback', { type: 'set_speed', factor: Number(value) })}
        />
        <Icon of={ChevronDown} />
      </div>
      <Achieved lab={lab} />
    </div>
  );
}

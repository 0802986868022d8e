// The slider over the ticks that the session can rewind to.

import { createEffect, createMemo, type JSX } from 'solid-js';
import { clock } from '../../ui/format';
import { createPending } from '../../ui/pending';
import { ticksToControlStep } from './steps';
import { EventMarks } from './EventMarks';
import { ScriptMarks } from './ScriptMarks';
import type { Events, Session, Trial } from '../../lab/slices';
import './Timeline.css';

export function Timeline(props: { lab: Session & Trial & Events }): JSX.Element {
  const { lab } = props;
  const oldest = createMemo(() => lab.state()?.oldest_tick ?? 0);
  // The newest kept tick may be a little before the present.
  const newest = createMemo(() => {
    const state = lab.state();
    return state ? Math.max(state.newest_tick, state.tick) : 0;
  });
  const moment = createPending(
    () => lab.state()?.tick ?? 0,
    (tick) => lab.send('playback', { type: 'rewind', tick }),
  );
  const tick = moment.value;
  const seconds = (ticks: number): string => clock(ticks * (lab.scene()?.tick_s ?? 0));
  let slider!: HTMLInputElement;
  createEffect(() => {
    // In this order: a value outside the old ends would be clamped to them.
    slider.min = String(oldest());
    slider.max = String(newest());
    slider.value = String(tick());
  });

  return (
    <div class="track">
      <EventMarks lab={lab} oldest={oldest()} newest={newest()} />
      <ScriptMarks lab={lab} oldest={oldest()} newest={newest()} />
      <input
        ref={slider}
        type="range"
        aria-label="Timeline"
        aria-valuetext={seconds(tick())}
        title="Rewind: the session pauses at this time"
        step="1"
        aria-busy={moment.isPending()}
        disabled={!lab.canOperate() || newest() === oldest()}
        onInput={(event) => {
          moment.choose(event.currentTarget.valueAsNumber);
        }}
        onKeyDown={(event) => {
          if (event.key !== 'ArrowRight' && event.key !== 'ArrowUp') return;
          // The session can only rewind to control steps, so the next tick is not a target.
          event.preventDefault();
          const now = tick();
          const next = now + ticksToControlStep(now, lab.scene()?.tick_s ?? Infinity);
          if (next <= newest()) moment.choose(next);
        }}
      />
    </div>
  );
}

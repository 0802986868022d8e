// The slider over the ticks that the session can rewind to, with what happened when.

import { createEffect, createMemo, type JSX } from 'solid-js';
import { clock } from '../../ui/format';
import { createPending } from '../../ui/pending';
import type { TimeAxis } from '../../lab/timeAxis';
import type { Contested, Events, Panels, Session, Trial } from '../../lab/slices';
import { Band, percent } from './Band';
import { ticksToControlStep } from './steps';
import { EventMarks } from './EventMarks';
import { PlannedMarks } from './PlannedMarks';
import './Timeline.css';

export function Timeline(props: {
  lab: Session & Trial & Events & Panels & Contested;
  axis: TimeAxis;
}): JSX.Element {
  const { lab, axis } = props;
  const tick_s = createMemo(() => lab.scene()?.tick_s ?? 0);
  // The newest kept tick may be a little before the present.
  const newest = createMemo(() => {
    const state = lab.state();
    return state ? Math.max(state.newest_tick, state.tick) : 0;
  });
  const toTick = (time_s: number): number => (tick_s() > 0 ? Math.round(time_s / tick_s()) : 0);
  /** Ends of the slider: what a rewind reaches, as far as it is on the axis. */
  const first = createMemo(() =>
    Math.max(lab.state()?.oldest_tick ?? 0, toTick(axis.span().from_s)),
  );
  const last = createMemo(() => Math.min(newest(), toTick(axis.span().to_s)));
  const moment = createPending(
    () => lab.state()?.tick ?? 0,
    (tick) => lab.send('playback', { type: 'rewind', tick }),
  );
  const tick = moment.value;
  let slider!: HTMLInputElement;
  createEffect(() => {
    // In this order: a value outside the old ends would be clamped to them.
    slider.min = String(first());
    slider.max = String(last());
    slider.value = String(tick());
  });
  const share = (at: number): number => axis.share(at * tick_s());

  return (
    <div class="track">
      <EventMarks lab={lab} axis={axis} />
      <Band lab={lab} axis={axis} now_s={tick() * tick_s()} newest_s={newest() * tick_s()} />
      <PlannedMarks lab={lab} axis={axis} />
      <input
        ref={slider}
        type="range"
        aria-label="Timeline"
        aria-valuetext={clock(tick() * tick_s())}
        title="Rewind: the session pauses at this time"
        step="1"
        style={{
          // Its thumb stops half its width before both ends.
          left: `calc(${percent(share(first()))} - var(--thumb) / 2)`,
          width: `calc(${percent(Math.max(0, share(last()) - share(first())))} + var(--thumb))`,
        }}
        aria-busy={moment.isPending()}
        disabled={!lab.canOperate() || newest() === first()}
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

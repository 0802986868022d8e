// The ticks that can be gone back to, with what happened on the way.

import { createEffect, createMemo, createSignal, onCleanup, type JSX } from 'solid-js';
import { clock } from '../../ui/format';
import { Limiter } from '../../net/limiter';
import { ticksToControlStep } from './steps';
import { EventMarks } from './EventMarks';
import { ScriptMarks } from './ScriptMarks';
import type { Events, Session, Trial } from '../../lab/slices';

const MAX_REWINDS_PER_S = 15;
/** How long the slider stays where it was let go, until the server's answer is here. */
const SETTLE_MS = 300;

export function Timeline(props: { lab: Session & Trial & Events }): JSX.Element {
  const { lab } = props;
  const [scrubbed, setScrubbed] = createSignal<number>();
  const oldest = createMemo(() => lab.state()?.oldest_tick ?? 0);
  // The newest moment kept may be some ticks behind the present.
  const newest = createMemo(() => {
    const state = lab.state();
    return state ? Math.max(state.newest_tick, state.tick) : 0;
  });
  const tick = (): number => scrubbed() ?? lab.state()?.tick ?? 0;
  const seconds = (ticks: number): string => clock(ticks * (lab.scene()?.tick_s ?? 0));
  const rewinds = new Limiter<number>(1000 / MAX_REWINDS_PER_S, (to) => {
    lab.send({ type: 'rewind', tick: to });
  });
  let slider!: HTMLInputElement;
  createEffect(() => {
    // In this order: a value outside the old ends would be clamped to them.
    slider.min = String(oldest());
    slider.max = String(newest());
    slider.value = String(tick());
  });
  let settle: ReturnType<typeof setTimeout> | undefined;
  const letGo = (): void => {
    rewinds.flush();
    clearTimeout(settle);
    settle = setTimeout(() => setScrubbed(undefined), SETTLE_MS);
  };
  onCleanup(() => {
    clearTimeout(settle);
  });

  return (
    <div class="timeline">
      <span class="end number">{seconds(oldest())}</span>
      <div class="track">
        <EventMarks lab={lab} oldest={oldest()} newest={newest()} />
        <ScriptMarks lab={lab} oldest={oldest()} newest={newest()} />
        <input
          ref={slider}
          type="range"
          aria-label="Timeline"
          aria-valuetext={seconds(tick())}
          title="Go back: time pauses there"
          step="1"
          disabled={!lab.canOperate() || newest() === oldest()}
          onInput={(event) => {
            const to = event.currentTarget.valueAsNumber;
            clearTimeout(settle);
            setScrubbed(to);
            rewinds.offer(to);
          }}
          onChange={letGo}
          // Back where it began it is let go without a change.
          onPointerUp={letGo}
          onPointerCancel={letGo}
          onKeyDown={(event) => {
            if (event.key !== 'ArrowRight' && event.key !== 'ArrowUp') return;
            // Only control steps can be selected, and the next tick is not one.
            event.preventDefault();
            const now = tick();
            const next = now + ticksToControlStep(now, lab.scene()?.tick_s ?? Infinity);
            if (next <= newest()) lab.send({ type: 'rewind', tick: next });
          }}
        />
      </div>
      <span class="end number">{seconds(newest())}</span>
    </div>
  );
}

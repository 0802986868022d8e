// The slider over the ticks that the session can rewind to.

import { createEffect, createMemo, createSignal, onCleanup, type JSX } from 'solid-js';
import { clock } from '../../ui/format';
import { Limiter } from '../../net/limiter';
import { ticksToControlStep } from './steps';
import { EventMarks } from './EventMarks';
import { ScriptMarks } from './ScriptMarks';
import type { Events, Session, Trial } from '../../lab/slices';
import './Timeline.css';

const MAX_REWINDS_PER_S = 15;
/** How long the slider stays where it was released, until the server answers. */
const SETTLE_MS = 300;

export function Timeline(props: {
  lab: Session & Trial & Events;
  /** At the end of the line. */
  beside: JSX.Element;
}): JSX.Element {
  const { lab } = props;
  const [scrubbed, setScrubbed] = createSignal<number>();
  const oldest = createMemo(() => lab.state()?.oldest_tick ?? 0);
  // The newest kept tick may be a little before the present.
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
          title="Rewind: the session pauses at this time"
          step="1"
          disabled={!lab.canOperate() || newest() === oldest()}
          onInput={(event) => {
            const to = event.currentTarget.valueAsNumber;
            clearTimeout(settle);
            setScrubbed(to);
            rewinds.offer(to);
          }}
          onChange={letGo}
          // Released where it started: no change event.
          onPointerUp={letGo}
          onPointerCancel={letGo}
          onKeyDown={(event) => {
            if (event.key !== 'ArrowRight' && event.key !== 'ArrowUp') return;
            // The session can only rewind to control steps, so the next tick is not a target.
            event.preventDefault();
            const now = tick();
            const next = now + ticksToControlStep(now, lab.scene()?.tick_s ?? Infinity);
            if (next <= newest()) lab.send({ type: 'rewind', tick: next });
          }}
        />
      </div>
      <span class="end number">{seconds(newest())}</span>
      {props.beside}
    </div>
  );
}

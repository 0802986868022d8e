// The parts of the paper's figure as lanes above the time line, live.

import { For, Index, createEffect, createSignal, on, onCleanup, type JSX } from 'solid-js';
import type { PanelProps } from '../../lab/panel';
import type { ByHand, Events, Notices, Trial } from '../../lab/slices';
import type { TimeAxis } from '../../lab/timeAxis';
import { createShownParts } from './chosen';
import { Lane } from './Lane';
import { PARTS } from './parts';
import { PlotMenu } from './PlotMenu';
import { Rotation } from './rotation';
import { type Sample, takeSample } from './sample';
import { tickWords, timeTicks } from './ticks';
import './plots.css';

export default function PlotLanes(
  props: PanelProps<Trial & Events & Notices & ByHand> & { axis: TimeAxis },
): JSX.Element {
  const { lab, axis } = props;
  const parts = createShownParts();
  const take = (): Sample | undefined => {
    const state = lab.state();
    return state && takeSample(lab.history, axis.span(), state.sim_time_s, lab.marks());
  };
  let sample: Sample | undefined;
  const samples = PARTS.map(() => createSignal<Sample>());
  const rotation = new Rotation(
    () => parts().length,
    () => {
      sample = take();
    },
    (lane) => samples[lane]?.[1](sample),
    (work) => requestAnimationFrame(work),
  );
  createEffect(on([lab.state, lab.marks, axis.span, parts], () => rotation.offer()));
  onCleanup(() => rotation.stop());
  return (
    <>
      <For each={parts()}>
        {(part, lane) => (
          <Lane
            part={part}
            axis={axis}
            sample={samples[lane()]?.[0]()}
            threshold_m={lab.scene()?.parameters.threshold_m}
          />
        )}
      </For>
      <div class="lane-times number" aria-hidden="true">
        <Index each={timeTicks(axis.span())}>
          {(time_s) => (
            <span style={{ left: `${100 * axis.share(time_s())}%` }}>{tickWords(time_s())}</span>
          )}
        </Index>
      </div>
      <PlotMenu lab={lab} axis={axis} take={take} />
    </>
  );
}

// State shared by the parts of the figure: the shown sample and the time under the pointer.

import { createSignal, type Accessor } from 'solid-js';
import { type Sample, takeSample, type WindowChoice } from './sample';
import type { Events, Trial } from '../../lab/slices';

export interface Figure {
  readonly sample: () => Sample | undefined;
  readonly choice: Accessor<WindowChoice>;
  /** Time under a pointer, in any part. */
  readonly pointed_s: Accessor<number | undefined>;
  point(time_s: number | undefined): void;
  choose(choice: WindowChoice): void;
  /** Takes a new sample of the history. The parts draw it one after the other. */
  renew(): void;
}

export function createFigure(lab: Trial & Events): Figure {
  const [choice, setChoice] = createSignal<WindowChoice>('60');
  const [pointed_s, setPointed] = createSignal<number>();
  let sample: Sample | undefined;
  return {
    sample: () => sample,
    choice,
    pointed_s,
    point: (time_s) => {
      setPointed(time_s);
    },
    choose: (next) => {
      setChoice(next);
    },
    renew: () => {
      const state = lab.state();
      if (state) sample = takeSample(lab.history, choice(), state.sim_time_s, lab.marks());
    },
  };
}

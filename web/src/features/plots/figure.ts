// State shared by the parts of the figure: the window and the time under the pointer.

import { createSignal, type Accessor } from 'solid-js';
import { nearestIndex, type Sample, takeSample, type WindowChoice } from './sample';
import type { Events, Trial } from '../../lab/slices';

export interface Figure {
  readonly choice: Accessor<WindowChoice>;
  readonly choose: (choice: WindowChoice) => void;
  /** Time under a pointer, in any part. */
  readonly pointed_s: Accessor<number | undefined>;
  readonly point: (time_s: number | undefined) => void;
  /** The sample under a pointer, otherwise the present one. */
  readonly indexIn: (sample: Sample | undefined) => number | undefined;
  /** Takes a sample of the history. The parts draw it one after the other. */
  take(): Sample | undefined;
}

export function createFigure(lab: Trial & Events): Figure {
  const [choice, choose] = createSignal<WindowChoice>('60');
  const [pointed_s, point] = createSignal<number>();
  const take = (): Sample | undefined => {
    const state = lab.state();
    return state && takeSample(lab.history, choice(), state.sim_time_s, lab.marks());
  };
  const indexIn = (sample: Sample | undefined): number | undefined =>
    sample && nearestIndex(sample.columns.sim_time_s, pointed_s() ?? sample.at_s);
  return { choice, choose, pointed_s, point, indexIn, take };
}

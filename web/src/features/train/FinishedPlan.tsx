// A finished training that plays while one's own has nothing to show yet. It is shipped with the page.

import {
  Show,
  createEffect,
  createMemo,
  createResource,
  createSignal,
  onCleanup,
  type JSX,
} from 'solid-js';
import { checkOfMap } from '../../lab/maps';
import { counted } from '../../ui/format';
import { prefersLessMotion } from '../../ui/motion';
import { rangeOf } from './colourRange';
import type { Finished } from './finished';
import { layers } from './state';
import { TrainingPlan } from './TrainingPlan';

const PLAY_MS = 700;
/** Its last value map stays for as many others. */
const REST = 4;

function Playing(props: { of: Finished; before: string }): JSX.Element {
  const { query, cells, frames } = props.of;
  const [map] = createResource(() => checkOfMap(query.map));
  const isStill = prefersLessMotion();
  const [at, setAt] = createSignal(0);
  createEffect(() => {
    if (isStill()) return;
    const timer = setInterval(() => setAt((at() + 1) % (frames.length + REST)), PLAY_MS);
    onCleanup(() => clearInterval(timer));
  });
  const last = frames.length - 1;
  const frame = createMemo(() => frames[isStill() ? last : Math.min(at(), last)]);
  return (
    <>
      <TrainingPlan
        label={`Plan of ${query.map} with the values of a finished training`}
        map={map.error === undefined ? map() : undefined}
        cells={cells}
        frame={frame()}
        range={rangeOf(frames.flatMap(({ values }) => values))}
        layers={layers()}
      />
      <Show when={props.before !== ''}>
        <p class="train-veil">
          {props.before} <strong>A finished training</strong> on the map {query.map}, after{' '}
          <span class="number">{counted(frame()?.update ?? 0, 'update')}</span>.
        </p>
      </Show>
    </>
  );
}

export function FinishedPlan(props: {
  /** What is said before its name, on the plan; empty if its name stands elsewhere. */
  before: string;
}): JSX.Element {
  const [finished] = createResource(async () => (await import('./finished.gen')).FINISHED);
  return (
    <Show when={finished.error === undefined && finished()}>
      {(one) => <Playing of={one()} before={props.before} />}
    </Show>
  );
}

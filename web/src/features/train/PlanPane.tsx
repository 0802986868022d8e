// The plan of a watched training on the stage.

import { Show, createEffect, createSignal, type JSX } from 'solid-js';
import { checkOfMap } from '../../lab/maps';
import { isActive, progressWords } from '../../lab/trainingStage';
import type { MapCheck } from '../../net/protocol.gen';
import { createAttempt } from '../../ui/attempt';
import { FinishedPlan } from './FinishedPlan';
import { layers, playsFinished, setPlace } from './state';
import { TrainingPlan } from './TrainingPlan';
import type { Watch } from './watch';

/** Id of the text that describes the plans. */
export const HELP_ID = 'train-help';

/** Before the first training: the walls of its map, or a finished training. */
export function FirstPane(props: { map: string }): JSX.Element {
  return (
    <Show when={playsFinished()} fallback={<MapPane map={props.map} />}>
      <section class="train-pane" aria-label="A finished training">
        <FinishedPlan before="" />
      </section>
    </Show>
  );
}

function MapPane(props: { map: string }): JSX.Element {
  const [map, setMap] = createSignal<MapCheck>();
  const { attempt } = createAttempt();
  createEffect(() => {
    if (props.map !== '') void attempt(checkOfMap(props.map).then(setMap));
  });
  return (
    <section class="train-pane" aria-label={props.map}>
      <TrainingPlan label={`Plan of ${props.map}`} map={map()} layers={layers()} />
    </section>
  );
}

export function PlanPane(props: {
  watch: Watch;
  /** What the training does, one sentence. */
  sentence: string;
  /** The values of the first and the last colour. */
  range: readonly [number, number] | undefined;
  /** Whether its name is written above it. */
  isNamed: boolean;
}): JSX.Element {
  const { watch } = props;
  const query = () => watch.summary().query;
  const empty = (): string =>
    isActive(watch.summary())
      ? `${props.sentence} The first value map comes with the first updates.`
      : 'This training has no value maps.';
  /** The toy's first value map comes at once. */
  const isEarly = (): boolean =>
    watch.count() === 0 && isActive(watch.summary()) && query().recipe !== 'toy';
  return (
    <section class="train-pane" aria-label={query().name}>
      <Show when={props.isNamed}>
        <h3>
          {query().name}
          <span class="about number">
            {query().map} · {progressWords(watch.summary())}
          </span>
        </h3>
      </Show>
      <Show when={!isEarly()} fallback={<FinishedPlan before={`${props.sentence} Meanwhile:`} />}>
        <TrainingPlan
          label={`Plan of ${query().map} with the values of ${query().name}`}
          helpId={HELP_ID}
          map={watch.map()}
          cells={watch.cells()}
          frame={watch.frame()}
          range={props.range}
          layers={layers()}
          chosen={watch.cell()}
          onChoose={setPlace}
        />
        <Show when={watch.count() === 0}>
          <p class="train-veil">{empty()}</p>
        </Show>
      </Show>
      <p class="refusal train-veil" role="alert">
        {watch.error()}
      </p>
    </section>
  );
}

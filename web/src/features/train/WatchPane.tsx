// One training: its value map, the scrubber over its value maps, and the chosen cell.

import {
  Show,
  createEffect,
  createMemo,
  createSignal,
  createUniqueId,
  onCleanup,
  type JSX,
} from 'solid-js';
import { checkOfMap } from '../../lab/maps';
import type {
  MapCheck,
  TrainingFrame,
  TrainingPoint,
  TrainingSummary,
} from '../../net/protocol.gen';
import { isActive, progressWords } from '../../lab/trainingStage';
import { createAttempt } from '../../ui/attempt';
import { counted } from '../../ui/format';
import { SmallButton } from '../../ui/SmallButton';
import { IS_TOUCH } from '../../ui/touch';
import { CellPanel } from './CellPanel';
import { Facts } from './Facts';
import { cellAt } from './grid';
import { layers, place_m, setPlace } from './state';
import { TrainingPlan } from './TrainingPlan';
import { ValueScale } from './TrainLegend';
import { coarseToFine, createValueMaps } from './valueMaps';

const PLAY_MS = 350;

export function WatchPane(props: {
  /** Its id stays the same. */
  summary: TrainingSummary;
  points: readonly TrainingPoint[];
  /** What the training does, one sentence. */
  sentence: string;
  /** The values of the first and the last colour. */
  range: readonly [number, number] | undefined;
  /** Whether more value maps may widen the range. */
  isGrowing: boolean;
}): JSX.Element {
  const help = createUniqueId();
  const [map, setMap] = createSignal<MapCheck>();
  const walls = createAttempt();
  void walls.attempt(checkOfMap(props.summary.query.map).then(setMap));
  /** Index of the shown value map; undefined: the newest. */
  const [at, setAt] = createSignal<number>();
  const [isPlaying, setPlaying] = createSignal(false);
  const count = createMemo(() => props.summary.frames);
  const last = (): number => Math.max(0, count() - 1);
  const index = createMemo(() => Math.min(at() ?? last(), last()));
  const maps = createValueMaps(
    () => props.summary,
    // All of them for the fan of a cell.
    () =>
      [index(), ...(cell() === undefined ? [] : coarseToFine(count()))].filter(
        (one) => one < count(),
      ),
  );
  const cell = createMemo(() => {
    const [cells, place] = [maps.cells(), place_m()];
    return cells && place && cellAt(cells, place);
  });
  // The one before stays until the next one has arrived.
  const frame = createMemo<TrainingFrame | undefined>((before) => maps.frames()[index()] ?? before);
  const read = createMemo(() => maps.frames().filter((one) => one !== undefined));
  const isLoaded = (): boolean => maps.frames()[index()] !== undefined;
  createEffect(() => {
    if (!isPlaying()) return;
    const timer = setInterval(() => {
      // A value map that is slow to arrive is waited for.
      if (!isLoaded()) return;
      if (index() < last()) setAt(index() + 1);
      else {
        setAt(undefined);
        setPlaying(false);
      }
    }, PLAY_MS);
    onCleanup(() => {
      clearInterval(timer);
    });
  });
  let scrubber!: HTMLInputElement;
  createEffect(() => {
    // In this order: a value above the limit would be lowered to it.
    scrubber.max = String(last());
    scrubber.value = String(index());
  });
  const name = (): string => props.summary.query.name;
  const empty = (): string =>
    isActive(props.summary)
      ? `${props.sentence} The first value map comes with the first updates.`
      : 'This training has no value maps.';
  const words = (): string => {
    const now = frame();
    if (now) return `after ${counted(now.update, 'update')}`;
    return isActive(props.summary) ? 'no value map yet' : '–';
  };
  return (
    <section class="train-pane" aria-label={name()}>
      <h3>
        {name()}
        <span class="about">{props.summary.query.map}</span>
        <span class="train-now about number">{progressWords(props.summary)}</span>
      </h3>
      <div class="train-picture">
        <TrainingPlan
          label={`Plan of ${props.summary.query.map} with the values of ${name()}`}
          helpId={help}
          map={map()}
          cells={maps.cells()}
          frame={frame()}
          range={props.range}
          layers={layers()}
          chosen={cell()}
          onChoose={setPlace}
        />
        <Show when={count() === 0}>
          <p class="train-veil">{empty()}</p>
        </Show>
      </div>
      <ValueScale range={props.range} isGrowing={props.isGrowing} />
      <div class="train-time">
        <SmallButton
          aria-label={`${isPlaying() ? 'Stop' : 'Play'} the value maps of ${name()}`}
          disabled={count() < 2}
          onClick={() => {
            if (!isPlaying() && index() === last()) setAt(0);
            setPlaying(!isPlaying());
          }}
        >
          {isPlaying() ? 'Stop' : 'Play'}
        </SmallButton>
        <input
          ref={scrubber}
          type="range"
          min="0"
          step="1"
          disabled={count() < 2}
          aria-label={`Value map of ${name()}`}
          aria-valuetext={words()}
          onInput={({ currentTarget }) => {
            setPlaying(false);
            setAt(currentTarget.valueAsNumber);
          }}
        />
        <SmallButton
          aria-label={`Follow the newest value map of ${name()}`}
          aria-pressed={at() === undefined}
          onClick={() => {
            setPlaying(false);
            setAt(undefined);
          }}
        >
          Newest
        </SmallButton>
        <output class="number" aria-live="off" data-testid="train-update">
          {words()}
        </output>
      </div>
      <p class="refusal" role="alert">
        {maps.error() ?? walls.refusal()}
      </p>
      <Facts summary={props.summary} points={props.points} frame={frame()} />
      <p id={help} class="hint">
        <Show
          when={cell() === undefined}
          fallback={
            IS_TOUCH ? 'Tap another cell to see its values.' : 'Arrow keys choose the next cell.'
          }
        >
          {IS_TOUCH ? 'Tap a cell' : 'Click a cell, or use the arrow keys on the plan,'} to see how
          its value changes with the updates.
        </Show>
      </p>
      <Show when={maps.cells()}>
        {(cells) => (
          <Show when={cell() !== undefined}>
            <CellPanel
              cells={cells()}
              cell={cell() ?? 0}
              frame={frame()}
              frames={read()}
              count={count()}
              total={props.summary.updates_total}
            />
          </Show>
        )}
      </Show>
    </section>
  );
}

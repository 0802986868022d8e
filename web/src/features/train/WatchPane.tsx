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
import type { MapCheck, TrainingFrame } from '../../net/protocol.gen';
import { isActive, progressWords } from '../../lab/trainingStage';
import { createAttempt } from '../../ui/attempt';
import { counted } from '../../ui/format';
import type { Palette } from '../../ui/palette';
import { SmallButton } from '../../ui/SmallButton';
import type { Theme } from '../../ui/theme';
import { IS_TOUCH } from '../../ui/touch';
import { CellPanel } from './CellPanel';
import { Facts } from './Facts';
import { cellAt } from './grid';
import type { Live } from './live';
import { layers, place_m, setPlace } from './state';
import { TrainingPlan } from './TrainingPlan';
import { ValueScale } from './TrainLegend';

const PLAY_MS = 350;

export function WatchPane(props: {
  live: Live;
  /** What the training does, one sentence. */
  sentence: string;
  /** The values of the first and the last colour. */
  range: readonly [number, number] | undefined;
  /** Whether more value maps may widen the range. */
  isGrowing: boolean;
  palette: () => Palette;
  theme: () => Theme;
}): JSX.Element {
  const { live } = props;
  const help = createUniqueId();
  const [map, setMap] = createSignal<MapCheck>();
  const walls = createAttempt();
  void walls.attempt(checkOfMap(live.summary().query.map).then(setMap));
  /** Index of the shown value map; undefined: the newest. */
  const [at, setAt] = createSignal<number>();
  const [isPlaying, setPlaying] = createSignal(false);
  const count = createMemo(() => live.summary().frames);
  const last = (): number => Math.max(0, count() - 1);
  const index = createMemo(() => Math.min(at() ?? last(), last()));
  // The one before stays until the next one has arrived.
  const frame = createMemo<TrainingFrame | undefined>((before) => live.frame(index()) ?? before);
  const isLoaded = (): boolean => live.frame(index()) !== undefined;
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
  const cell = createMemo(() => {
    const [cells, place] = [live.cells(), place_m()];
    return cells && place && cellAt(cells, place);
  });
  createEffect(() => {
    if (cell() !== undefined) live.readAll();
  });
  let scrubber!: HTMLInputElement;
  createEffect(() => {
    // In this order: a value above the limit would be lowered to it.
    scrubber.max = String(last());
    scrubber.value = String(index());
  });
  const name = (): string => live.summary().query.name;
  const empty = (): string =>
    isActive(live.summary())
      ? `${props.sentence} The first value map comes with the first updates.`
      : 'This training has no value maps.';
  const words = (): string => {
    const now = frame();
    if (now) return `after ${counted(now.update, 'update')}`;
    return isActive(live.summary()) ? 'no value map yet' : '–';
  };
  return (
    <section class="train-pane" aria-label={name()}>
      <h3>
        {name()}
        <span class="about">{live.summary().query.map}</span>
        <span class="train-now about number">{progressWords(live.summary())}</span>
      </h3>
      <div class="train-picture">
        <TrainingPlan
          label={`Plan of ${live.summary().query.map} with the values of ${name()}`}
          helpId={help}
          palette={props.palette()}
          map={map()}
          cells={live.cells()}
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
        {live.error() ?? walls.refusal()}
      </p>
      <Facts summary={live.summary()} points={live.points()} frame={frame()} />
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
      <Show when={live.cells()}>
        {(cells) => (
          <Show when={cell() !== undefined}>
            <CellPanel
              cells={cells()}
              cell={cell() ?? 0}
              frame={frame()}
              frames={live.frames()}
              count={count()}
              total={live.summary().updates_total}
              palette={props.palette}
              theme={props.theme}
            />
          </Show>
        )}
      </Show>
    </section>
  );
}

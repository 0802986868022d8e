// Time of the watched trainings, in updates; what their plans show; and their curves.

import { For, Show, createEffect, type JSX } from 'solid-js';
import { Activity, Play, Square } from 'lucide';
import { Icon } from '../../ui/Icon';
import { Toggle } from '../../ui/Toggle';
import type { Layers } from './drawFrame';
import { hasCurves, layers, setCurves, setLayers } from './state';
import type { Watch } from './watch';

const LAYERS: readonly (readonly [keyof Layers, label: string, title: string])[] = [
  ['values', 'Values', 'What the policy expects from each cell'],
  ['arrows', 'Best steps', 'The step with the highest value at each cell'],
  ['starts', 'Failing starts', 'Cells from which the best steps do not lead to the shown goal'],
  ['episodes', 'Episodes', 'Some episodes to the goal, again and again'],
];

function TimeRow(props: { watch: Watch }): JSX.Element {
  const { watch } = props;
  let slider!: HTMLInputElement;
  createEffect(() => {
    // In this order: a value above the limit would be lowered to it.
    slider.max = String(watch.last());
    slider.value = String(watch.index());
  });
  const name = (): string => watch.summary().query.name;
  /** How far the training is: the rest of the line is not there yet. */
  const share = (): number => {
    const { updates, updates_total } = watch.summary();
    return updates / Math.max(1, updates_total);
  };
  return (
    <div class="time-row train-time">
      <output class="number" aria-live="off" data-testid="train-update">
        <Show when={watch.frame()} fallback={watch.words()}>
          {(frame) => (
            <>
              <span>after </span>
              <b>{frame().update}</b>
              <span> {frame().update === 1 ? 'update' : 'updates'}</span>
            </>
          )}
        </Show>
      </output>
      <span class="train-track">
        <input
          ref={slider}
          type="range"
          min="0"
          step="1"
          style={{ width: `max(96px, ${100 * share()}%)` }}
          disabled={watch.count() < 2}
          aria-label={`Value map of ${name()}`}
          aria-valuetext={watch.words()}
          onInput={({ currentTarget }) => watch.show(currentTarget.valueAsNumber)}
        />
      </span>
      <button
        type="button"
        class="small"
        aria-label={`Follow the newest value map of ${name()}`}
        aria-pressed={watch.isNewest()}
        onClick={() => watch.show(undefined)}
      >
        Newest
      </button>
    </div>
  );
}

function PlayButton(props: { watch: Watch; isFirst: boolean; isAlone: boolean }): JSX.Element {
  const { watch } = props;
  const name = (): string => watch.summary().query.name;
  const verb = (): string => (watch.isPlaying() ? 'Stop' : 'Replay');
  return (
    <button
      type="button"
      class={props.isFirst ? 'primary' : undefined}
      aria-label={`${verb()} the value maps of ${name()}`}
      title={watch.count() < 2 ? 'There are no value maps yet' : undefined}
      disabled={watch.count() < 2}
      onClick={watch.playOrStop}
    >
      <Icon of={watch.isPlaying() ? Square : Play} />
      {props.isAlone ? verb() : name()}
    </button>
  );
}

export function Dock(props: { watches: readonly Watch[] }): JSX.Element {
  return (
    <Show
      when={props.watches.length > 0}
      fallback={<p class="train-empty">Here you will go back and forth through a training.</p>}
    >
      <For each={props.watches}>{(watch) => <TimeRow watch={watch} />}</For>
      <div class="transport train-transport">
        <div class="train-plays">
          <For each={props.watches}>
            {(watch, index) => (
              <PlayButton
                watch={watch}
                isFirst={index() === 0}
                isAlone={props.watches.length === 1}
              />
            )}
          </For>
        </div>
        <div class="train-layers" role="group" aria-label="Show">
          <span aria-hidden="true">Show</span>
          <For each={LAYERS}>
            {([id, label, title]) => (
              <Toggle
                title={title}
                isOn={layers()[id]}
                onChange={(isOn) => setLayers({ ...layers(), [id]: isOn })}
              >
                {label}
              </Toggle>
            )}
          </For>
        </div>
        <button
          type="button"
          class="train-more"
          aria-pressed={hasCurves()}
          onClick={() => setCurves(!hasCurves())}
        >
          <Icon of={Activity} />
          Curves
        </button>
      </div>
    </Show>
  );
}

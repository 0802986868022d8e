// Legend of the value layer.

import { Show, type JSX } from 'solid-js';
import { fixed } from '../../ui/format';
import { MapLegend, Ramp } from '../../ui/MapLegend';
import type { ValueMap } from '../../net/protocol.gen';
import { valueRange } from '../../plan/values';

export function ValueLegend(props: {
  map: ValueMap | undefined;
  error: string | undefined;
  hasGoal: boolean;
}): JSX.Element {
  const waits = (): string | undefined =>
    props.error === undefined ? 'calculating the values of the whole map…' : undefined;
  return (
    <MapLegend
      name="Values"
      error={props.error}
      // Always there: when the values come, the map above keeps its size.
      below={
        <p class="words">
          Expected discounted return at each place for this goal
          {props.map?.has_memory
            ? ', by what the camera has seen so far'
            : ', with images of the default camera'}
          . Arrows show the best step.
        </p>
      }
    >
      <span>Value</span>
      <Show when={props.hasGoal} fallback={<span>Set a goal to see the values.</span>}>
        <Show when={props.map} fallback={waits()}>
          {(map) => (
            <>
              <Show when={valueRange(map())}>
                {(range) => (
                  <Ramp of="value" least={fixed(range()[0], 2)} greatest={fixed(range()[1], 2)} />
                )}
              </Show>
              <span class="aside">Trained on: {map().trained_on.join(', ')}</span>
            </>
          )}
        </Show>
      </Show>
    </MapLegend>
  );
}

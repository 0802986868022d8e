// Legend of the value layer.

import { Show, type JSX } from 'solid-js';
import { fixed } from '../../ui/format';
import type { ValueMap } from '../../net/protocol.gen';
import { valueRange } from '../../plan/values';
import '../../ui/legend.css';
import './values.css';

function Range(props: { map: ValueMap }): JSX.Element {
  return (
    <>
      <Show when={valueRange(props.map)}>
        {(range) => (
          <>
            <span class="number" data-testid="value-least">
              {fixed(range()[0], 2)}
            </span>
            <span class="heat-ramp" aria-hidden="true" />
            <span class="number" data-testid="value-greatest">
              {fixed(range()[1], 2)}
            </span>
          </>
        )}
      </Show>
      <span class="aside">Trained on: {props.map.trained_on.join(', ')}</span>
    </>
  );
}

export function ValueLegend(props: {
  map: ValueMap | undefined;
  error: string | undefined;
  hasGoal: boolean;
}): JSX.Element {
  const waits = (): string | undefined =>
    props.error === undefined ? 'calculating the values of the whole map…' : undefined;
  return (
    <div class="map-legend" role="group" aria-label="Values">
      <span>Value</span>
      <Show when={props.hasGoal} fallback={<span>Set a goal to see the values.</span>}>
        <Show when={props.map} fallback={waits()}>
          {(map) => <Range map={map()} />}
        </Show>
      </Show>
      <span role="alert">
        <Show when={props.error}>{(text) => <span class="refusal">{text()}</span>}</Show>
      </span>
      {/* Always there: when the values come, the map above keeps its size. */}
      <p class="words">
        Expected discounted return at each place for this goal
        {props.map?.has_memory
          ? ', by what the camera has seen so far'
          : ', with images of the default camera'}
        . Arrows show the best step.
      </p>
    </div>
  );
}

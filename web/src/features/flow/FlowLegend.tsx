// What the arrows and dots of the attractor's flow mean.

import { Show, type JSX } from 'solid-js';
import type { Answer } from '../../net/requests';
import type { FlowField, Parameters } from '../../net/protocol.gen';
import type { Flow } from './drawFlow';

/** What the dots are: the literal law remembers nothing, the improved one follows a contour on one side. */
function trapWords(law: Parameters['attractor_law']): string {
  return law === 'literal'
    ? 'ends short of the goal: trapped'
    : 'ends short of the goal, unless a contour is followed on';
}

export function FlowLegend(props: {
  answer: Answer<FlowField>;
  flow: Flow | undefined;
  hasGoal: boolean;
  law: Parameters['attractor_law'];
}): JSX.Element {
  return (
    <div class="map-legend flow" role="group" aria-label="Arrows and dots">
      <Show when={props.hasGoal} fallback={<span>Place a goal to see the flow.</span>}>
        <span title="Longer is faster. From what the camera has shown; faint where it has shown nothing, which counts as free">
          <span class="flow-arrow" aria-hidden="true">
            →
          </span>
          where the attractor leads
        </span>
        <span title="As if the tool came to each place anew, without a contour that it follows">
          <span class="flow-trap" aria-hidden="true" />
          {trapWords(props.law)}{' '}
          <Show when={!props.answer.error}>
            <span class="number" data-testid="flow-traps">
              {props.flow ? `(${props.flow.traps.length || 'none'})` : '(computing…)'}
            </span>
          </Show>
        </span>
      </Show>
      <span role="alert">
        <Show when={props.answer.error}>{(text) => <span class="refusal">{text()}</span>}</Show>
      </span>
    </div>
  );
}

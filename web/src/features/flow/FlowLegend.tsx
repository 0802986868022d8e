// Legend of the attractor flow layer.

import { Show, type JSX } from 'solid-js';
import type { Answer } from '../../net/requests';
import type { FlowField, Parameters } from '../../net/protocol.gen';
import { MapLegend } from '../../ui/MapLegend';
import type { Flow } from './drawFlow';
import './flow.css';

/** Meaning of the dots. The literal law has no memory; the improved law follows a contour on one side. */
function trapWords(law: Parameters['attractor_law']): string {
  return law === 'literal'
    ? 'the flow ends before the goal: a trap'
    : 'the flow ends before the goal, except when the tool already follows a contour';
}

export function FlowLegend(props: {
  answer: Answer<FlowField>;
  flow: Flow | undefined;
  hasGoal: boolean;
  law: Parameters['attractor_law'];
}): JSX.Element {
  return (
    <MapLegend class="flow" name="Arrows and dots" error={props.answer.error}>
      <Show when={props.hasGoal} fallback={<span>Set a goal to see the flow.</span>}>
        <span title="Longer arrows are faster. The flow uses what the camera has shown. Arrows are faint where it has shown nothing; these places count as free">
          <span class="flow-arrow" aria-hidden="true">
            →
          </span>
          direction of the attractor flow
        </span>
        <span title="Calculated for each place as if the tool did not follow a contour yet">
          <span class="flow-trap" aria-hidden="true" />
          {trapWords(props.law)}{' '}
          <Show when={!props.answer.error}>
            <span class="number" data-testid="flow-traps">
              {props.flow ? `(${props.flow.traps.length || 'none'})` : '(computing…)'}
            </span>
          </Show>
        </span>
      </Show>
    </MapLegend>
  );
}

// Legend of the singularity layer.

import { Show, type JSX } from 'solid-js';
import type { Answer } from '../../net/requests';
import type { WorkspaceMap } from '../../net/protocol.gen';
import { MapLegend, Ramp } from '../../ui/MapLegend';
import { heatRange, heatWords, refusedWords } from './heat';
import './singularity.css';

function Values(props: { map: WorkspaceMap }): JSX.Element {
  return (
    <>
      <Show when={heatRange(props.map)}>
        {(range) => (
          <>
            <Ramp of="heat" least={heatWords(range()[0])} greatest={heatWords(range()[1])} />
            <span>·10⁻³ m³</span>
          </>
        )}
      </Show>
      <span class="aside">
        <span class="heat-hatch" aria-hidden="true" />
        singular (below {heatWords(props.map.least_m3)}) or out of reach: {refusedWords(props.map)}
      </span>
    </>
  );
}

export function HeatLegend(props: { answer: Answer<WorkspaceMap> }): JSX.Element {
  return (
    <MapLegend name="Manipulability" error={props.answer.error}>
      <span title="|det J| of the arm over the table; 0 is a singularity">Manipulability</span>
      <Show when={props.answer.data} fallback={props.answer.error ? undefined : 'computing…'}>
        {(map) => <Values map={map()} />}
      </Show>
    </MapLegend>
  );
}

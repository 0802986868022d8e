// Legend of the magnetic field layer.

import { Show, type JSX } from 'solid-js';
import type { Answer } from '../../net/requests';
import type { Plane } from '../../net/protocol.gen';
import { fieldWords, strongestWords } from './plane';
import '../../ui/legend.css';
import './field.css';

export function FieldLegend(props: { answer: Answer<Plane> }): JSX.Element {
  return (
    <div class="map-legend" role="group" aria-label="Magnetic field">
      <span title="Flux density of the upright magnet block, at the height of the bead's centre">
        |B|
      </span>
      <Show when={props.answer.data} fallback={props.answer.error ? undefined : 'computing…'}>
        {(plane) => (
          <>
            <span class="number">0</span>
            <span class="heat-ramp of-field" aria-hidden="true" />
            <span class="number" data-testid="field-greatest">
              {fieldWords(plane())}
            </span>
            <span>mT</span>
            <span class="aside">
              <span class="flow-arrow" aria-hidden="true">
                →
              </span>
              pull on the bead, up to{' '}
              <span class="number" data-testid="field-pull">
                {strongestWords(plane())}
              </span>{' '}
              mN
            </span>
          </>
        )}
      </Show>
      <span role="alert">
        <Show when={props.answer.error}>{(text) => <span class="refusal">{text()}</span>}</Show>
      </span>
    </div>
  );
}

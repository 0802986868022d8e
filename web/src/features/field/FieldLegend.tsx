// Legend of the magnetic field layer.

import { Show, type JSX } from 'solid-js';
import type { Answer } from '../../net/requests';
import type { Plane } from '../../net/protocol.gen';
import { MapLegend, Ramp } from '../../ui/MapLegend';
import { fieldWords, strongestWords } from './plane';

export function FieldLegend(props: { answer: Answer<Plane> }): JSX.Element {
  return (
    <MapLegend name="Magnetic field" error={props.answer.error}>
      <span title="Flux density of the upright magnet block, at the height of the bead's centre">
        |B|
      </span>
      <Show when={props.answer.data} fallback={props.answer.error ? undefined : 'computing…'}>
        {(plane) => (
          <>
            <Ramp of="field" least="0" greatest={fieldWords(plane())} />
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
    </MapLegend>
  );
}

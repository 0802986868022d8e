// The walls of a map of the server, small. The drawing is the mask of their colour: every shape in it is a wall.

import { Show, type JSX } from 'solid-js';
import { svgAddress } from './maps';
import './MapPicture.css';

export function MapPicture(props: { map: string | undefined }): JSX.Element {
  return (
    <span class="map-picture" aria-hidden="true">
      <Show when={props.map}>
        {(map) => <span style={{ 'mask-image': `url("${svgAddress(map())}")` }} />}
      </Show>
    </span>
  );
}

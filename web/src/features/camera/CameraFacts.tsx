// What is in the camera's image, beside it.

import { Show, type JSX } from 'solid-js';
import { fixed } from '../../ui/format';
import type { OverlayMessage } from '../../net/protocol.gen';
import { Fact } from '../../ui/Fact';

export function CameraFacts(props: {
  overlay: OverlayMessage | undefined;
  /** Whether the controller senses obstacles in it. */
  sensesObstacles: boolean;
}): JSX.Element {
  const of = (words: (overlay: OverlayMessage) => string): string =>
    props.overlay ? words(props.overlay) : '–';
  return (
    <dl class="facts" aria-label="In the camera's image">
      <Fact
        name="At the tool"
        value={of(({ obstacle }) => (obstacle ? 'obstacle' : 'clear'))}
        alarm={props.overlay?.obstacle ?? false}
      />
      <Fact name="Brightness" value={of(({ center_mean }) => fixed(center_mean, 0))} />
      <Show when={props.sensesObstacles}>
        <Fact name="Obstacles" value={of(({ obstacles }) => String(obstacles.length))} />
      </Show>
    </dl>
  );
}

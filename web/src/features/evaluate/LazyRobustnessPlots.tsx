// The plots' code is loaded with the first evaluation that varies a parameter.

import { Show, type JSX } from 'solid-js';
import { lazyPart } from '../../ui/lazyPart';
import type { RobustnessProps } from './RobustnessPlots';

const Plots = lazyPart<RobustnessProps>(
  async () => (await import('./RobustnessPlots')).RobustnessPlots,
  () => <p class="placeholder">Loading…</p>,
  () => (
    <p class="placeholder" role="alert">
      The plots could not be loaded. Reload the page.
    </p>
  ),
);

export function LazyRobustnessPlots(props: RobustnessProps): JSX.Element {
  return (
    <Show when={props.summary.query.vary.length > 0}>
      <Plots {...props} />
    </Show>
  );
}

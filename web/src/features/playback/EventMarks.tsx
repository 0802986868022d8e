// The events on the timeline. Each is a button that opens the event's story.

import { Index, Show, createMemo, createSignal, onMount, type JSX } from 'solid-js';
import { onSize } from '../../ui/size';
import { clusters, markTitle } from './eventMarks';
import type { EventMessage } from '../../net/protocol.gen';
import { Icon } from '../../ui/Icon';
import type { TimeAxis } from '../../lab/timeAxis';
import type { Events, Panels, Trial } from '../../lab/slices';

/** Marks nearer than this share one. */
const GAP_PX = 25;
const LEFT_PX = 8;
/** Number of marks that a key moves by. */
const MOVES: Partial<Record<string, number>> = { ArrowLeft: -1, ArrowRight: 1 };

export function EventMarks(props: { lab: Trial & Events & Panels; axis: TimeAxis }): JSX.Element {
  const { lab, axis } = props;
  let bar!: HTMLDivElement;
  const [width_px, setWidth] = createSignal(0);
  onMount(() => {
    onSize(bar, ({ width }) => setWidth(width));
  });
  const found = createMemo(() => {
    const { from_s, to_s } = axis.span();
    // The first one is not over the time.
    const px = (time_s: number): number => Math.max(LEFT_PX, width_px() * axis.share(time_s));
    const held = lab.marks().filter(({ sim_time_s: at }) => at >= from_s && at <= to_s);
    return width_px() > 0 ? clusters(held, px, GAP_PX) : [];
  });
  const [current, setCurrent] = createSignal<EventMessage>();
  // Tab reaches one mark: the last chosen one, otherwise the newest.
  const reached = createMemo(() => {
    const chosen = current();
    const index = found().findIndex(({ events }) => chosen && events.includes(chosen));
    return index >= 0 ? index : found().length - 1;
  });
  const onKey = (event: KeyboardEvent): void => {
    const move = MOVES[event.key];
    if (move === undefined || found().length === 0) return;
    event.preventDefault();
    const index = Math.min(found().length - 1, Math.max(0, reached() + move));
    setCurrent(found()[index]?.first);
    bar.querySelectorAll('button')[index]?.focus();
  };
  const isOpen = (events: readonly EventMessage[]): boolean => {
    const open = lab.inspected();
    return open !== undefined && events.includes(open);
  };
  return (
    <div ref={bar} class="event-marks" role="toolbar" aria-label="Events in time" onKeyDown={onKey}>
      {/* Keyed by index and not by value, so that a mark keeps the focus when another one comes. */}
      <Index each={found()}>
        {(cluster, index) => (
          <button
            type="button"
            class="mark"
            data-kind={cluster().first.kind}
            style={{ left: `${cluster().px}px`, color: `var(--${cluster().look.colour})` }}
            tabindex={reached() === index ? 0 : -1}
            aria-label={cluster().name}
            title={markTitle(cluster().events)}
            aria-pressed={isOpen(cluster().events)}
            onClick={() => {
              setCurrent(cluster().first);
              lab.inspect(cluster().first);
              lab.showPanel('story');
            }}
          >
            <Show when={cluster().events.length > 1} fallback={<Icon of={cluster().look.icon} />}>
              {cluster().events.length}
            </Show>
          </button>
        )}
      </Index>
    </div>
  );
}

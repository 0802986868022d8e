// The events on the timeline. Each is a button that opens the event's story.

import { Index, createEffect, createMemo, createSignal, onMount, type JSX } from 'solid-js';
import { onSize } from '../../ui/size';
import { Limiter } from '../../net/limiter';
import { clusters, markTitle } from './eventMarks';
import type { EventMessage } from '../../net/protocol.gen';
import type { Events } from '../../lab/slices';

/** Side of a mark, the same as `--target` in the style sheet. */
const GAP_PX = matchMedia('(pointer: coarse)').matches ? 36 : 24;
/**
 * While the simulation runs, hundreds of marks move a little with each state. Updating them sixty times per second is
 * not necessary.
 */
const LAYOUTS_PER_S = 4;
/** Number of marks that a key moves by. */
const MOVES: Partial<Record<string, number>> = { ArrowLeft: -1, ArrowRight: 1 };

export function EventMarks(props: { lab: Events; oldest: number; newest: number }): JSX.Element {
  const { lab } = props;
  let bar!: HTMLDivElement;
  const [width_px, setWidth] = createSignal(0);
  onMount(() => {
    onSize(bar, ({ width }) => setWidth(width));
  });
  const [line, setLine] = createSignal({ oldest: 0, newest: 0, marks: lab.marks() });
  const layouts = new Limiter(1000 / LAYOUTS_PER_S, setLine);
  createEffect(() => {
    layouts.offer({ oldest: props.oldest, newest: props.newest, marks: lab.marks() });
  });
  const found = createMemo(() => {
    const { oldest, newest, marks } = line();
    const span = Math.max(1, newest - oldest);
    const px = (tick: number): number => (width_px() * Math.min(span, tick - oldest)) / span;
    const held = marks.filter((mark) => mark.tick >= oldest);
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
      {/* Keyed by index and not by value, because every mark moves in a running session. */}
      <Index each={found()}>
        {(cluster, index) => (
          <button
            type="button"
            class="mark"
            data-kind={cluster().first.kind}
            data-count={cluster().events.length > 1 ? cluster().events.length : undefined}
            style={{ left: `${cluster().px}px` }}
            tabindex={reached() === index ? 0 : -1}
            aria-label={cluster().name}
            title={markTitle(cluster().events)}
            aria-pressed={isOpen(cluster().events)}
            onClick={() => {
              setCurrent(cluster().first);
              lab.inspect(cluster().first);
            }}
          >
            {cluster().symbol}
          </button>
        )}
      </Index>
    </div>
  );
}

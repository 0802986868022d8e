// What has just happened, for a moment at its place: a delivery, a loss, a fetch, another controller, a refused goal.

import { Show, createEffect, createSignal, on, onCleanup, type JSX } from 'solid-js';
import { CONTROLLER_LABELS } from '../lab/parameters';
import type { Trial } from '../lab/slices';
import type { StateMessage } from '../net/protocol.gen';
import type { Interaction } from './interaction';
import './Moments.css';

const SHOWN_MS = 1200;
/** A sentence needs longer. */
const REFUSED_MS = 2500;

export interface Happened {
  readonly kind: 'delivered' | 'lost' | 'fetched' | 'switched' | 'refused';
  readonly words: string;
  readonly at_m: readonly [number, number, number];
}

/** What a state shows that the one before did not; nothing after a rewind or a reset. */
export function happened(before: StateMessage, now: StateMessage): Happened | undefined {
  if (!now.running || now.tick <= before.tick) return undefined;
  if (now.deliveries > before.deliveries && now.goal_m)
    return { kind: 'delivered', words: 'Delivered', at_m: now.goal_m };
  if (now.mode !== before.mode)
    return now.mode === 1
      ? { kind: 'lost', words: 'Lost', at_m: now.bead_m }
      : { kind: 'fetched', words: 'Fetched', at_m: now.bead_m };
  if (now.controller !== before.controller)
    return { kind: 'switched', words: CONTROLLER_LABELS[now.controller], at_m: now.tool_m };
  return undefined;
}

export function Moments(props: { lab: Trial; interaction: Interaction }): JSX.Element {
  const { lab, interaction } = props;
  const [shown, setShown] = createSignal<Happened>();
  createEffect(
    on(lab.state, (now, before) => {
      const next = before && now && happened(before, now);
      if (next) setShown(next);
    }),
  );
  createEffect(
    on(
      interaction.refused,
      (now) => now && setShown({ kind: 'refused', words: now.words, at_m: [...now.at, 0] }),
      { defer: true },
    ),
  );
  createEffect(() => {
    const kind = shown()?.kind;
    if (!kind) return;
    const time_ms = kind === 'refused' ? REFUSED_MS : SHOWN_MS;
    const timer = setTimeout(() => setShown(undefined), time_ms);
    onCleanup(() => clearTimeout(timer));
  });
  const px = (): readonly [number, number] | undefined => {
    const [x, y, z] = shown()?.at_m ?? [];
    if (x === undefined || y === undefined) return undefined;
    return interaction.view()?.toPx([x, y], z);
  };
  return (
    <Show when={shown()} keyed>
      {({ kind, words }) => (
        <span
          class="moment"
          data-kind={kind}
          aria-hidden="true"
          style={{ left: `${px()?.[0] ?? 0}px`, top: `${px()?.[1] ?? 0}px` }}
        >
          <b>{words}</b>
        </span>
      )}
    </Show>
  );
}

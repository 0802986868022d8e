// The runs that rewinds, resets and other scenarios have left behind, and a way back to each.

import { For, Show, createEffect, createMemo, createSignal, type JSX } from 'solid-js';
import { History } from 'lucide';
import { CommandButton } from '../../lab/CommandButton';
import type { Session, Trial } from '../../lab/slices';
import { Icon } from '../../ui/Icon';
import { createPopover } from '../../ui/popover';
import { runWords } from './runs';
import './runs.css';

/** Number of the newest run that the user has seen; undefined until the first scene. Outside of the component, which goes with the laboratory. */
const [seen, setSeen] = createSignal<number>();

export function KeptRuns(props: { lab: Session & Trial }): JSX.Element {
  const { lab } = props;
  const popover = createPopover('kept-runs');
  /** Newest first. */
  const runs = createMemo(() => [...(lab.scene()?.kept_runs ?? [])].reverse());
  const newest = createMemo(() => runs()[0]?.number ?? 0);
  createEffect(() => {
    if (!lab.scene()) return;
    // What was there when the page was opened is no news. A new session counts from 1 again.
    const last = seen();
    if (last === undefined || popover.open() || newest() < last) setSeen(newest());
  });
  const isFresh = (): boolean => newest() > (seen() ?? newest());
  return (
    <div {...popover.box} class="runs">
      <button
        {...popover.button}
        class="ghost icon-only"
        classList={{ fresh: isFresh() }}
        title={
          isFresh()
            ? `Run ${newest()} was kept. Open the list to return to it.`
            : 'What rewinds, resets and other experiments have left behind'
        }
        disabled={runs().length === 0}
      >
        <Icon of={History} />
        <span class="visually-hidden">Kept runs</span>
        <Show when={runs().length > 0}>
          <span class="runs-count number">{runs().length}</span>
        </Show>
      </button>
      <Show when={popover.open() && runs().length > 0}>
        <ol id="kept-runs" class="runs-list popover" aria-label="Kept runs">
          <For each={runs()}>
            {(run) => (
              <li>
                <span>
                  <strong>Run {run.number}</strong> {runWords(run)}
                </span>
                <CommandButton
                  lab={lab}
                  at="playback"
                  class="small"
                  aria-label={`Return to run ${run.number}`}
                  title="Pauses at its end. The present run is kept."
                  command={() => ({ type: 'return_to', run: run.number })}
                  onDone={popover.close}
                >
                  Return
                </CommandButton>
              </li>
            )}
          </For>
        </ol>
      </Show>
    </div>
  );
}

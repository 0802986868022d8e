// The runs that rewinds, resets and other scenarios have left behind, and a way back to each.

import { For, Show, createMemo, type JSX } from 'solid-js';
import type { Session, Trial } from '../../lab/slices';
import { createPopover } from '../../ui/popover';
import { runWords } from './runs';
import './runs.css';

export function KeptRuns(props: { lab: Session & Trial }): JSX.Element {
  const { lab } = props;
  let box!: HTMLDivElement;
  let button!: HTMLButtonElement;
  const { open, setOpen, onFocusOut } = createPopover(
    () => box,
    () => button,
  );
  /** Newest first. */
  const runs = createMemo(() => [...(lab.scene()?.kept_runs ?? [])].reverse());
  return (
    <div ref={box} class="runs" onFocusOut={onFocusOut}>
      <button
        ref={button}
        type="button"
        class="small"
        title="What rewinds, resets and other experiments have left behind"
        aria-expanded={open()}
        aria-controls="kept-runs"
        disabled={runs().length === 0}
        onClick={() => {
          setOpen(!open());
        }}
      >
        Kept runs <span class="runs-count number">{runs().length}</span>
      </button>
      <Show when={open() && runs().length > 0}>
        <ol id="kept-runs" class="runs-list" aria-label="Kept runs">
          <For each={runs()}>
            {(run) => (
              <li>
                <span>
                  <strong>Run {run.number}</strong> {runWords(run)}
                </span>
                <button
                  type="button"
                  class="small"
                  aria-label={`Return to run ${run.number}`}
                  title="Pauses at its end. The present run is kept."
                  disabled={!lab.canOperate()}
                  onClick={() => {
                    lab.send({ type: 'return_to', run: run.number });
                    setOpen(false);
                    button.focus();
                  }}
                >
                  Return
                </button>
              </li>
            )}
          </For>
        </ol>
      </Show>
    </div>
  );
}

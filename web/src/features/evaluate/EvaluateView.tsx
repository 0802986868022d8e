// The view Evaluate: the results on the stage, a new evaluation and the earlier ones in the inspector.

import { Show, createMemo, createSignal, type JSX } from 'solid-js';
import { Empty } from '../../ui/Empty';
import { ForKeyed } from '../../ui/ForKeyed';
import { ChartColumn } from 'lucide';
import { EvaluationForm } from './EvaluationForm';
import { EvaluationPanel } from './EvaluationPanel';
import { episodesDone, episodesInAll, numberOf, subject } from './progress';
import { Stage } from './Stage';
import { takeOpened } from '../../lab/jobs';
import { isActive } from '../../lab/trainingStage';
import type { EvaluationSummary } from '../../net/protocol.gen';
import type { Addressed, Session, Trial } from '../../lab/slices';
import './EvaluateView.css';

/** Outside of the component, so that it survives a change to the laboratory and back. */
const [chosen, setChosen] = createSignal<string>();

function Entry(props: { summary: EvaluationSummary; current: boolean }): JSX.Element {
  return (
    <button
      type="button"
      class="evaluation-entry"
      aria-current={props.current ? 'true' : undefined}
      onClick={() => setChosen(props.summary.id)}
    >
      <b>{numberOf(props.summary.id)}</b>
      <Stage
        of={props.summary}
        words={
          isActive(props.summary)
            ? `${episodesDone(props.summary)} of ${episodesInAll(props.summary)}`
            : undefined
        }
      />
      <span class="entry-about rule">{subject(props.summary)}</span>
    </button>
  );
}

export default function EvaluateView(props: { lab: Addressed & Session & Trial }): JSX.Element {
  const all = (): readonly EvaluationSummary[] => props.lab.catalog.evaluations() ?? [];
  /** The chosen evaluation, otherwise the newest. */
  const shown = createMemo(() => all().find(({ id }) => id === chosen()) ?? all().at(-1));
  takeOpened('evaluation', setChosen);
  return (
    <>
      <main class="view evaluate">
        <Show
          when={shown()}
          fallback={
            <Empty icon={ChartColumn} question="How many of many trials succeed?">
              An evaluation counts it for random trials, as in the paper. Choose controllers and
              maps, then press Run. It runs in the background and does not slow down the live
              session.
            </Empty>
          }
        >
          {(summary) => <EvaluationPanel lab={props.lab} summary={summary()} />}
        </Show>
      </main>
      <aside class="inspector" aria-label="New evaluation">
        <div class="inspector-panel">
          <h2>New evaluation</h2>
          <EvaluationForm lab={props.lab} onStarted={setChosen}>
            <section class="evaluation-entries" aria-label="Evaluations">
              <h3>Earlier</h3>
              <ForKeyed each={all().toReversed()} by={({ id }) => id}>
                {(summary) => <Entry summary={summary()} current={shown()?.id === summary().id} />}
              </ForKeyed>
              <Show when={props.lab.catalog.evaluations()?.length === 0}>
                <p class="placeholder">
                  No evaluations yet. The server keeps the last 16 until it is stopped.
                </p>
              </Show>
            </section>
          </EvaluationForm>
        </div>
      </aside>
    </>
  );
}

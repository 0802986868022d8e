// The Evaluate view: the request on the left, the results on the right.

import { Show, createMemo, createSignal, type JSX } from 'solid-js';
import { ForKeyed } from '../../ui/ForKeyed';
import { Panel } from '../../ui/Panel';
import { EvaluationForm } from './EvaluationForm';
import { EvaluationPanel } from './EvaluationPanel';
import { episodesDone, episodesInAll, numberOf, stageWords, subject } from './progress';
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
      onClick={() => {
        setChosen(props.summary.id);
      }}
    >
      <span class="entry-head">
        <strong>{numberOf(props.summary.id)}</strong>
        <span class="evaluation-stage number" data-stage={props.summary.stage}>
          {isActive(props.summary)
            ? `${episodesDone(props.summary)} of ${episodesInAll(props.summary)}`
            : stageWords(props.summary)}
        </span>
      </span>
      <span class="entry-about">{subject(props.summary)}</span>
    </button>
  );
}

export default function EvaluateView(props: { lab: Addressed & Session & Trial }): JSX.Element {
  const all = (): readonly EvaluationSummary[] => props.lab.catalog.evaluations() ?? [];
  /** The chosen evaluation, otherwise the newest. */
  const shown = createMemo(() => all().find(({ id }) => id === chosen()) ?? all().at(-1));
  return (
    <main class="view evaluate">
      <div class="evaluate-left">
        <Panel name="New evaluation">
          <EvaluationForm lab={props.lab} measured={all()} onStarted={setChosen} />
        </Panel>
        <Panel name="Evaluations">
          <div class="evaluation-entries">
            <ForKeyed each={all().toReversed()} by={({ id }) => id}>
              {(summary) => <Entry summary={summary()} current={shown()?.id === summary().id} />}
            </ForKeyed>
            <Show when={props.lab.catalog.evaluations()?.length === 0}>
              <p class="placeholder">
                No evaluations yet. The server keeps the last 16 until it is stopped.
              </p>
            </Show>
          </div>
        </Panel>
      </div>
      <Show
        when={shown()}
        fallback={
          <section class="panel evaluation">
            <p class="placeholder">
              An evaluation counts how many of many random trials succeed, as in the paper. Choose
              controllers and maps, then press Run. It runs in the background and does not slow down
              the live session.
            </p>
          </section>
        }
      >
        {(summary) => <EvaluationPanel lab={props.lab} summary={summary()} />}
      </Show>
    </main>
  );
}

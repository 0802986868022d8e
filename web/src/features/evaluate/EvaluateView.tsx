// The Evaluate view: the request on the left, the results on the right.

import { For, Show, createMemo, createSignal, type JSX } from 'solid-js';
import type { Theme } from '../../ui/theme';
import { EvaluationForm } from './EvaluationForm';
import { EvaluationPanel } from './EvaluationPanel';
import { episodesDone, episodesInAll, isActive, numberOf, stageWords, subject } from './progress';
import type { EvaluationSummary } from '../../net/protocol.gen';
import type { Session, Trial } from '../../lab/slices';
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
      <span class="entry-about">
        {subject(props.summary)}; {props.summary.query.episodes} per cell, seed{' '}
        {props.summary.query.seed}
      </span>
    </button>
  );
}

export interface EvaluateProps {
  readonly lab: Session & Trial;
  readonly theme: () => Theme;
  readonly onLaboratory: () => void;
}

export function EvaluateView(props: EvaluateProps): JSX.Element {
  const { catalog } = props.lab;
  const all = (): readonly EvaluationSummary[] => catalog.evaluations() ?? [];
  const ids = createMemo(() => all().map(({ id }) => id), [], {
    equals: (a, b) => a.join() === b.join(),
  });
  const byId = (id: string | undefined): EvaluationSummary | undefined =>
    all().find((one) => one.id === id);
  /** The chosen evaluation, otherwise the newest. */
  const shown = createMemo(() => byId(chosen()) ?? all().at(-1));
  return (
    <main class="view evaluate">
      <div class="evaluate-left">
        <section class="panel" aria-label="New evaluation">
          <header class="panel-head">
            <h2>New evaluation</h2>
          </header>
          <EvaluationForm lab={props.lab} measured={all()} onStarted={setChosen} />
        </section>
        <section class="panel" aria-label="Evaluations">
          <header class="panel-head">
            <h2>Evaluations</h2>
          </header>
          <div class="evaluation-entries">
            <For each={ids().toReversed()}>
              {(id) => (
                <Show when={byId(id)}>
                  {(summary) => <Entry summary={summary()} current={shown()?.id === id} />}
                </Show>
              )}
            </For>
            <Show when={catalog.evaluations()?.length === 0}>
              <p class="placeholder">
                No evaluations yet. The server keeps the last 16 until it is stopped.
              </p>
            </Show>
          </div>
        </section>
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
        {(summary) => (
          <EvaluationPanel
            lab={props.lab}
            summary={summary()}
            theme={props.theme}
            onLaboratory={props.onLaboratory}
          />
        )}
      </Show>
    </main>
  );
}

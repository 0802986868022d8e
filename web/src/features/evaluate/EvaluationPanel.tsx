// One evaluation: progress, rows, failures.

import { For, Show, createMemo, on, type JSX } from 'solid-js';
import { Download } from 'lucide';
import { jobOf, leftWords, waitWords } from '../../lab/jobs';
import { operatorOnly } from '../../lab/operatorOnly';
import { createAttempt } from '../../ui/attempt';
import { Icon } from '../../ui/Icon';
import { SmallButton } from '../../ui/SmallButton';
import { isActive } from '../../lab/trainingStage';
import type { EvaluationSummary, JobSummary } from '../../net/protocol.gen';
import { ComparisonTable } from './ComparisonTable';
import { cancelEvaluation, createReport } from './evaluations';
import { EvaluationTable } from './EvaluationTable';
import { FailureList } from './FailureList';
import { episodesDone, episodesInAll, milestone, numberOf, subject } from './progress';
import { RobustnessPlots } from './RobustnessPlots';
import { Stage } from './Stage';
import { reportAddress, REPORTS } from './table';
import type { Addressed, Session, Trial } from '../../lab/slices';
import './EvaluationPanel.css';

function Progress(props: { summary: EvaluationSummary; job: JobSummary | undefined }): JSX.Element {
  const done = (): number => episodesDone(props.summary);
  const all = (): number => episodesInAll(props.summary);
  const words = (): string => {
    const counts = `${done()} of ${all()} episodes`;
    if (!isActive(props.summary)) return counts;
    if (props.summary.stage === 'waiting') return `${counts}, ${waitWords(props.job)}`;
    const left_s = props.job?.left_s ?? null;
    return left_s === null ? counts : `${counts}, ${leftWords(left_s)}`;
  };
  return (
    <div class="evaluation-progress">
      <progress
        max={all()}
        value={done()}
        aria-label="Progress"
        aria-valuetext={words()}
        data-stage={props.summary.stage}
      />
      <span class="number" data-testid="evaluation-progress">
        {words()}
      </span>
    </div>
  );
}

export function EvaluationPanel(props: {
  lab: Addressed & Session & Trial;
  summary: EvaluationSummary;
}): JSX.Element {
  const { lab } = props;
  const report = createReport(() => props.summary);
  const job = createMemo(() => jobOf(lab.catalog, props.summary.id));
  const said = createMemo(() => milestone(props.summary, job()));
  /** One for each evaluation, so that a refusal is shown at its own. */
  const cancelling = createMemo(on(() => props.summary.id, createAttempt));
  return (
    <section class="evaluation" aria-label={`Evaluation ${numberOf(props.summary.id)}`}>
      <header>
        <h2>Evaluation {numberOf(props.summary.id)}</h2>
        <Stage of={props.summary} testid="evaluation-stage" />
        <span class="hint">{subject(props.summary)}</span>
        <Show when={isActive(props.summary)}>
          <SmallButton
            {...operatorOnly(lab)}
            onClick={() => void cancelling().attempt(cancelEvaluation(props.summary.id))}
          >
            Cancel
          </SmallButton>
        </Show>
      </header>
      <p class="visually-hidden" role="status" data-testid="evaluation-said">
        {said()}
      </p>
      <Progress summary={props.summary} job={job()} />
      <p class="refusal" role="alert">
        {cancelling().refusal() ?? props.summary.message}
      </p>
      <Show when={report()}>
        {(now) => (
          <Show when={props.summary.query.vary.length > 0 && props.summary.id} keyed>
            <RobustnessPlots summary={props.summary} rows={now().rows} />
          </Show>
        )}
      </Show>
      <EvaluationTable summary={props.summary} rows={report()?.rows ?? []} />
      <Show when={(report()?.rows.length ?? 0) > 0 && report()}>
        {(now) => (
          <div class="downloads">
            <For each={REPORTS}>
              {(ending) => (
                <a
                  class="button small ghost"
                  href={reportAddress(now().id, ending)}
                  download=""
                  title={`Download the report as ${ending.toUpperCase()}`}
                >
                  <Icon of={Download} />
                  {ending.toUpperCase()}
                </a>
              )}
            </For>
          </div>
        )}
      </Show>
      <p class="hint">
        All controllers get the same starts, goals, seeds and disturbances on a map. The paper
        evaluated only RL, on its robot and in one maze, which <em>colon</em> is modelled on: 30
        episodes without disturbances and 30 with disturbances. It does not say how many
        disturbances each episode had; its figure shows three.
      </p>
      <Show when={report()}>
        {(now) => (
          <>
            <Show when={now().comparisons.length > 0}>
              <h3>Paired differences</h3>
              <ComparisonTable comparisons={now().comparisons} />
            </Show>
            <h3>Failures</h3>
            <FailureList lab={lab} report={now()} />
          </>
        )}
      </Show>
    </section>
  );
}

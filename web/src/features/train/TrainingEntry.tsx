// A training in the list. A press shows it.

import { Show, type JSX } from 'solid-js';
import { stageSentence } from '../../lab/trainingStage';
import type { JobSummary, TrainingSummary } from '../../net/protocol.gen';
import { SmallButton } from '../../ui/SmallButton';
import { StageBadge } from './StageBadge';

export function TrainingEntry(props: {
  summary: TrainingSummary;
  job: JobSummary | undefined;
  isShown: boolean;
  /** Whether it is shown beside the shown one. */
  isCompared: boolean;
  onChoose: () => void;
  onCompare: () => void;
}): JSX.Element {
  const name = (): string => props.summary.query.name;
  return (
    <li class="training-entry" data-shown={props.isShown ? '' : undefined}>
      <button
        type="button"
        class="training-choose"
        aria-current={props.isShown ? 'true' : undefined}
        onClick={() => props.onChoose()}
      >
        <strong>{name()}</strong> <span class="about">{props.summary.query.map}</span>{' '}
        <StageBadge summary={props.summary} />
      </button>
      <p class="training-words number">{stageSentence(props.summary, props.job)}</p>
      <Show when={!props.isShown}>
        <SmallButton
          aria-label={`Compare with ${name()}`}
          aria-pressed={props.isCompared}
          onClick={props.onCompare}
        >
          Compare
        </SmallButton>
      </Show>
    </li>
  );
}

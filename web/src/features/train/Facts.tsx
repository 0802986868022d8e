// How good the policy is: for the goal of the shown value map, and for all goals.

import { Show, createMemo, type JSX } from 'solid-js';
import { intervalWords, isActive, shareWords } from '../../lab/trainingStage';
import type { TrainingFrame, TrainingPoint, TrainingSummary } from '../../net/protocol.gen';
import { counted, fixed } from '../../ui/format';
import { newestExamination } from './curves';
import { startsThat } from './grid';

export function Facts(props: {
  summary: TrainingSummary;
  points: readonly TrainingPoint[];
  frame: TrainingFrame | undefined;
}): JSX.Element {
  const newest = createMemo(() => newestExamination(props.summary, props.points));
  const correlation = (): string => {
    const value = props.frame?.rank_correlation ?? null;
    return value === null ? '–' : fixed(value, 3);
  };
  return (
    <>
      <dl class="train-facts">
        <div>
          <dt>This goal</dt>
          <dd class="number">
            <Show when={props.frame} fallback="–">
              {(frame) => (
                <>
                  <strong data-testid="train-starts">
                    {startsThat(frame(), 'reached').length} of {frame().endings.length}
                  </strong>{' '}
                  starts reach it
                </>
              )}
            </Show>
          </dd>
        </div>
        <div>
          <dt>Random starts and goals</dt>
          <dd class="number">
            <Show when={newest()} fallback={isActive(props.summary) ? 'not examined yet' : '–'}>
              {(last) => (
                <span title={intervalWords(last().examined)}>
                  <strong data-testid="train-examined">{shareWords(last().examined)}</strong>{' '}
                  reached after {counted(last().update, 'update')}
                </span>
              )}
            </Show>
          </dd>
        </div>
        <div>
          <dt>Rank correlation</dt>
          <dd class="number">
            <strong data-testid="train-correlation">{correlation()}</strong>
          </dd>
        </div>
      </dl>
      <p class="rule">
        The value map shows one example goal
        {props.summary.query.goal_m === null ? ', in a far corner' : ''}. The policy learns all
        goals.
      </p>
    </>
  );
}

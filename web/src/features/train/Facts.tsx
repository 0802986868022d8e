// How good the policy is: for the goal of the shown value map, and for all goals.

import { Show, createMemo, type JSX } from 'solid-js';
import { intervalWords, isActive, shareWords } from '../../lab/trainingStage';
import type { TrainingFrame, TrainingPoint, TrainingSummary } from '../../net/protocol.gen';
import { Fact } from '../../ui/Fact';
import { counted, fixed } from '../../ui/format';
import { newestExamination } from './curves';
import { startsThat } from './grid';

export function Facts(props: {
  summary: TrainingSummary;
  points: readonly TrainingPoint[];
  frame: TrainingFrame | undefined;
}): JSX.Element {
  const newest = createMemo(() => newestExamination(props.summary, props.points));
  const starts = (): string => {
    const { frame } = props;
    return frame ? `${startsThat(frame, 'reached').length} of ${frame.endings.length}` : '–';
  };
  const examined = (): string => {
    const last = newest();
    if (last) return shareWords(last.examined);
    return isActive(props.summary) ? 'not examined yet' : '–';
  };
  const goals = (): string =>
    newest()?.examined.all_pairs ? 'All pairs of cells' : 'Random starts and goals';
  const correlation = (): string => {
    const value = props.frame?.rank_correlation ?? null;
    return value === null ? '–' : fixed(value, 3);
  };
  return (
    <>
      <dl class="facts">
        <Fact name="This goal: starts that reach it" value={starts()} testid="train-starts" />
        <Fact name={goals()} value={examined()} testid="train-examined" />
        <Fact name="Rank correlation" value={correlation()} testid="train-correlation" />
      </dl>
      <p class="rule">
        <Show when={newest()}>
          {(last) => (
            <>
              Examined after {counted(last().update, 'update')}, {intervalWords(last().examined)}
              .{' '}
            </>
          )}
        </Show>
        The map shows one example goal
        {props.summary.query.goal_m === null ? ', in a far corner' : ''}. The policy learns all
        goals.
      </p>
    </>
  );
}

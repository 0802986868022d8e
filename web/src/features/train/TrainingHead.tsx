// A watched training: what it does, how far it is, and what can be done with it.

import { Show, createEffect, createSignal, type JSX } from 'solid-js';
import { operatorOnly } from '../../lab/operatorOnly';
import { policyName } from '../../lab/parameters';
import type { Session } from '../../lab/slices';
import { isActive, stageSentence, updateWords } from '../../lab/trainingStage';
import type { JobSummary, TrainingSummary } from '../../net/protocol.gen';
import { createAttempt } from '../../ui/attempt';
import { ConfirmButton } from '../../ui/ConfirmButton';
import { SmallButton } from '../../ui/SmallButton';
import { StageBadge } from './StageBadge';
import { discardTraining, pauseTraining, resumeTraining } from './trainings';
import { isOpen, type Wish } from './wish';

export function TrainingHead(props: {
  lab: Session;
  summary: TrainingSummary;
  job: JobSummary | undefined;
  /** Whether its policy was deleted after the training. */
  isDeleted: boolean;
  /** Whether its button may be the primary one. */
  isFirst: boolean;
  onUse: () => void;
  /** Opens the view Evaluate with its policy. */
  onEvaluate: () => void;
  /** It was removed from the list. */
  onRemoved: () => void;
}): JSX.Element {
  const { attempt, refusal } = createAttempt();
  const [wish, setWish] = createSignal<Wish>();
  let heading!: HTMLHeadingElement;
  const name = (): string => props.summary.query.name;
  const canPause = (): boolean => isActive(props.summary) && props.summary.stage !== 'paused';
  const pauseVerb = (): string => (canPause() ? 'Pause' : 'Resume');
  createEffect(() => {
    const now = wish();
    if (now && !isOpen(now, props.summary.stage)) setWish(undefined);
  });
  const request = async (words: Wish['words'], change: Promise<unknown>): Promise<boolean> => {
    setWish({ words, from: props.summary.stage });
    const isTaken = await attempt(change);
    if (!isTaken) setWish(undefined);
    return isTaken;
  };
  const pauseOrResume = (): void => {
    const { id } = props.summary;
    if (wish()) return;
    if (canPause()) void request('pausing…', pauseTraining(id));
    else void request('resuming…', resumeTraining(id));
  };
  const cancel = (): Promise<boolean> => {
    const answer = request('cancelling…', discardTraining(props.summary.id));
    // The button with the focus is removed.
    heading.focus();
    return answer;
  };
  const removeIt = async (): Promise<void> => {
    if (await attempt(discardTraining(props.summary.id))) props.onRemoved();
  };
  const start = (): string => {
    const from = props.summary.query.start_from;
    return from === null ? 'random weights' : policyName(from);
  };
  const share = (): string => {
    const { stage, updates, updates_total } = props.summary;
    if (stage !== 'learning') return '';
    return `${Math.floor((100 * updates) / Math.max(1, updates_total))} % · `;
  };
  return (
    <div class="training-head stack" data-stage={props.summary.stage}>
      <header>
        <h2 ref={heading} tabindex="-1">
          {name()}
        </h2>
        <StageBadge summary={props.summary} words={wish()?.words} />
      </header>
      <p class="about">
        On <strong>{props.summary.query.map}</strong>, from {start()}.
      </p>
      <progress
        max={Math.max(1, props.summary.updates_total)}
        value={props.summary.updates}
        data-stage={props.summary.stage}
        aria-label={`Progress of ${name()}`}
        aria-valuetext={updateWords(props.summary)}
      />
      <p class="training-words number">
        {share()}
        {stageSentence(props.summary, props.job)}
      </p>
      <div class="training-deeds">
        <Show when={props.isDeleted}>
          <span class="about">policy deleted</span>
        </Show>
        <Show when={props.summary.policy !== null && !props.isDeleted}>
          <SmallButton
            {...operatorOnly(props.lab)}
            class={props.isFirst ? 'primary' : 'small'}
            aria-label={`Use it: ${name()}`}
            onClick={props.onUse}
          >
            Use it
          </SmallButton>
          <SmallButton
            aria-label={`Evaluate ${name()}`}
            title="Many random trials with this policy on its map"
            onClick={props.onEvaluate}
          >
            Evaluate
          </SmallButton>
        </Show>
        <Show when={isActive(props.summary) || props.summary.stage === 'failed'}>
          <SmallButton
            {...operatorOnly(props.lab)}
            aria-label={`${pauseVerb()} ${name()}`}
            aria-disabled={wish() !== undefined}
            onClick={pauseOrResume}
          >
            {pauseVerb()}
          </SmallButton>
        </Show>
        <Show
          when={isActive(props.summary)}
          fallback={
            <SmallButton
              {...operatorOnly(props.lab)}
              class="small ghost"
              aria-label={`Remove ${name()} from the list`}
              onClick={() => void removeIt()}
            >
              Remove
            </SmallButton>
          }
        >
          <Show
            when={wish()}
            fallback={
              <ConfirmButton
                {...operatorOnly(props.lab)}
                verb="Cancel"
                of={name()}
                onYes={cancel}
              />
            }
          >
            <SmallButton aria-label={`Cancel ${name()}`} aria-disabled="true">
              Cancel
            </SmallButton>
          </Show>
        </Show>
      </div>
      <p class="refusal" role="alert">
        {refusal()}
      </p>
    </div>
  );
}

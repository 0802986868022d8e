// A training in the list: what it does, and what can be done with it.

import { Show, createEffect, createSignal, type JSX } from 'solid-js';
import { operatorOnly } from '../../lab/operatorOnly';
import type { Session } from '../../lab/slices';
import { isActive, stageSentence, stageWords, updateWords } from '../../lab/trainingStage';
import type { TrainingSummary } from '../../net/protocol.gen';
import { createAttempt } from '../../ui/attempt';
import { ConfirmButton } from '../../ui/ConfirmButton';
import { SmallButton } from '../../ui/SmallButton';
import { discardTraining, pauseTraining, resumeTraining } from './trainings';
import { isOpen, type Wish } from './wish';

export function TrainingEntry(props: {
  lab: Session;
  summary: TrainingSummary;
  /** The trainings that were requested earlier. */
  before: readonly TrainingSummary[];
  isShown: boolean;
  /** Whether it is shown beside the shown one. */
  isCompared: boolean;
  /** Whether its policy was deleted after the training. */
  isDeleted: boolean;
  onChoose: () => void;
  onCompare: () => void;
  onUse: () => void;
  /** Opens the view Evaluate with its policy. */
  onEvaluate: () => void;
}): JSX.Element {
  const { attempt, refusal } = createAttempt();
  const [wish, setWish] = createSignal<Wish>();
  let entry!: HTMLLIElement;
  let choose!: HTMLButtonElement;
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
    choose.focus();
    return answer;
  };
  const removeIt = async (): Promise<void> => {
    const other = entry.nextElementSibling ?? entry.previousElementSibling;
    // The button is removed with its focus.
    if (await attempt(discardTraining(props.summary.id))) other?.querySelector('button')?.focus();
  };
  return (
    <li
      ref={entry}
      class="training-entry"
      data-shown={props.isShown ? '' : undefined}
      data-stage={props.summary.stage}
    >
      <button
        ref={choose}
        type="button"
        class="training-choose"
        aria-current={props.isShown ? 'true' : undefined}
        onClick={() => {
          props.onChoose();
        }}
      >
        <strong title={name()}>{name()}</strong>
        <span class="about">{props.summary.query.map}</span>
        <span class="training-stage">{wish()?.words ?? stageWords(props.summary)}</span>
      </button>
      <progress
        max={Math.max(1, props.summary.updates_total)}
        value={props.summary.updates}
        data-stage={props.summary.stage}
        aria-label={`Progress of ${name()}`}
        aria-valuetext={updateWords(props.summary)}
      />
      <p class="training-words number">{stageSentence(props.summary, props.before)}</p>
      <div class="training-deeds">
        <Show when={props.isDeleted}>
          <span class="about">policy deleted</span>
        </Show>
        <Show when={props.summary.policy !== null && !props.isDeleted}>
          <SmallButton
            {...operatorOnly(props.lab)}
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
        <Show when={!props.isShown}>
          <SmallButton
            aria-label={`Compare with ${name()}`}
            aria-pressed={props.isCompared}
            onClick={props.onCompare}
          >
            Compare
          </SmallButton>
        </Show>
      </div>
      <p class="refusal" role="alert">
        {refusal()}
      </p>
    </li>
  );
}

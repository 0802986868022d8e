// A training in the list: what it does, and what can be done with it.

import { Show, createEffect, createSignal, type JSX } from 'solid-js';
import type { TrainingSummary } from '../../net/protocol.gen';
import { ConfirmButton } from '../../ui/ConfirmButton';
import { isActive, stageSentence, stageWords, updateWords } from '../../lab/trainingStage';
import { discardTraining, pauseTraining, resumeTraining } from './trainings';
import { isOpen, type Wish } from './wish';

interface EntryProps {
  readonly summary: TrainingSummary;
  /** The trainings that were requested earlier. */
  readonly before: readonly TrainingSummary[];
  readonly isShown: boolean;
  readonly isCompared: boolean;
  /** Whether it can be shown beside the shown one. */
  readonly canCompare: boolean;
  readonly canOperate: boolean;
  /** Whether its policy was deleted after the training. */
  readonly isDeleted: boolean;
  readonly onChoose: () => void;
  readonly onCompare: () => void;
  readonly onUse: () => void;
  /** Opens the view Evaluate with its policy. */
  readonly onEvaluate: () => void;
}

export function TrainingEntry(props: EntryProps): JSX.Element {
  const [refusal, setRefusal] = createSignal<string>();
  const [wish, setWish] = createSignal<Wish>();
  let entry!: HTMLLIElement;
  let choose!: HTMLButtonElement;
  const name = (): string => props.summary.query.name;
  const attempt = async (change: Promise<unknown>): Promise<boolean> => {
    setRefusal(undefined);
    try {
      await change;
      return true;
    } catch (reason) {
      setRefusal(reason instanceof Error ? reason.message : String(reason));
      return false;
    }
  };
  const removeIt = async (): Promise<void> => {
    const other = entry.nextElementSibling ?? entry.previousElementSibling;
    // The button is removed with its focus.
    if (await attempt(discardTraining(props.summary.id))) other?.querySelector('button')?.focus();
  };
  const why = (): string | undefined =>
    props.canOperate ? undefined : 'Only the operator can do this';
  const isPaused = (): boolean => props.summary.stage === 'paused';
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
    if (isActive(props.summary) && !isPaused()) void request('pausing…', pauseTraining(id));
    else void request('resuming…', resumeTraining(id));
  };
  const cancel = (): Promise<boolean> => {
    const answer = request('cancelling…', discardTraining(props.summary.id));
    // The button with the focus is removed.
    choose.focus();
    return answer;
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
        <Show
          when={isActive(props.summary)}
          fallback={
            <>
              <Show when={props.isDeleted}>
                <span class="about">policy deleted</span>
              </Show>
              <Show when={props.summary.policy !== null && !props.isDeleted}>
                <button
                  type="button"
                  class="small"
                  aria-label={`Use it: ${name()}`}
                  disabled={!props.canOperate}
                  title={why()}
                  onClick={() => {
                    props.onUse();
                  }}
                >
                  Use it
                </button>
                <button
                  type="button"
                  class="small"
                  aria-label={`Evaluate ${name()}`}
                  title="Many random trials with this policy on its map"
                  onClick={() => {
                    props.onEvaluate();
                  }}
                >
                  Evaluate
                </button>
              </Show>
              <Show when={props.summary.stage === 'failed'}>
                <button
                  type="button"
                  class="small"
                  aria-label={`Resume ${name()}`}
                  disabled={!props.canOperate}
                  aria-disabled={wish() !== undefined}
                  title={why()}
                  onClick={pauseOrResume}
                >
                  Resume
                </button>
              </Show>
              <button
                type="button"
                class="small"
                aria-label={`Remove ${name()} from the list`}
                disabled={!props.canOperate}
                title={why()}
                onClick={() => void removeIt()}
              >
                Remove
              </button>
            </>
          }
        >
          <button
            type="button"
            class="small"
            aria-label={`${isPaused() ? 'Resume' : 'Pause'} ${name()}`}
            disabled={!props.canOperate}
            aria-disabled={wish() !== undefined}
            title={why()}
            onClick={pauseOrResume}
          >
            {isPaused() ? 'Resume' : 'Pause'}
          </button>
          <Show
            when={wish()}
            fallback={
              <ConfirmButton
                verb="Cancel"
                of={name()}
                disabled={!props.canOperate}
                title={why()}
                onYes={cancel}
              />
            }
          >
            <button
              type="button"
              class="small"
              aria-label={`Cancel ${name()}`}
              aria-disabled="true"
            >
              Cancel
            </button>
          </Show>
        </Show>
        <Show when={props.canCompare}>
          <button
            type="button"
            class="small"
            aria-label={`Compare with ${name()}`}
            aria-pressed={props.isCompared}
            onClick={() => {
              props.onCompare();
            }}
          >
            Compare
          </button>
        </Show>
      </div>
      <p class="refusal" role="alert">
        {refusal()}
      </p>
    </li>
  );
}

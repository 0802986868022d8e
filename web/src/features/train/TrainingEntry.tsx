// A training in the list: what it does, and what can be done with it.

import { Show, createSignal, type JSX } from 'solid-js';
import type { TrainingSummary } from '../../net/protocol.gen';
import { ConfirmButton } from '../../ui/ConfirmButton';
import { Fault } from './Fault';
import { isActive, stageSentence, stageWords, updateWords } from '../../lab/trainingStage';
import type { TrainingList } from './trainings';

interface EntryProps {
  readonly summary: TrainingSummary;
  /** The trainings that were requested earlier. */
  readonly before: readonly TrainingSummary[];
  readonly list: TrainingList;
  readonly isShown: boolean;
  readonly isCompared: boolean;
  /** Whether it can be shown beside the shown one. */
  readonly canCompare: boolean;
  readonly canOperate: boolean;
  readonly onChoose: () => void;
  readonly onCompare: () => void;
  readonly onUse: (reference: string) => void;
}

export function TrainingEntry(props: EntryProps): JSX.Element {
  const [refusal, setRefusal] = createSignal<string>();
  let entry!: HTMLLIElement;
  const name = (): string => props.summary.query.name;
  const attempt = async (change: Promise<void>): Promise<boolean> => {
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
    if (await attempt(props.list.discard(props.summary.id)))
      other?.querySelector('button')?.focus();
  };
  const why = (): string | undefined =>
    props.canOperate ? undefined : 'Only the operator can do this';
  const isPaused = (): boolean => props.summary.stage === 'paused';
  const resume = (): void => void attempt(props.list.resume(props.summary.id));
  const pause = (): void => void attempt(props.list.pause(props.summary.id));
  return (
    <li
      ref={entry}
      class="training-entry"
      data-shown={props.isShown ? '' : undefined}
      data-stage={props.summary.stage}
    >
      <button
        type="button"
        class="training-choose"
        aria-current={props.isShown ? 'true' : undefined}
        onClick={() => {
          props.onChoose();
        }}
      >
        <strong>{name()}</strong>
        <span class="about">{props.summary.query.map}</span>
        <span class="training-stage">{stageWords(props.summary)}</span>
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
              <Show when={props.summary.policy}>
                {(reference) => (
                  <button
                    type="button"
                    class="small"
                    aria-label={`Use it: ${name()}`}
                    disabled={!props.canOperate}
                    title={why()}
                    onClick={() => {
                      props.onUse(reference());
                    }}
                  >
                    Use it
                  </button>
                )}
              </Show>
              <Show when={props.summary.stage === 'failed'}>
                <button
                  type="button"
                  class="small"
                  aria-label={`Resume ${name()}`}
                  disabled={!props.canOperate}
                  title={why()}
                  onClick={resume}
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
            title={why()}
            onClick={() => {
              if (isPaused()) resume();
              else pause();
            }}
          >
            {isPaused() ? 'Resume' : 'Pause'}
          </button>
          <ConfirmButton
            verb="Cancel"
            of={name()}
            disabled={!props.canOperate}
            title={why()}
            onYes={() => attempt(props.list.discard(props.summary.id))}
          />
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
      <Fault id={`${props.summary.id}-refused`} text={refusal()} />
    </li>
  );
}

// A job in the list: what it is, how far it is, and what can be done with it.

import { Show, createSignal, type JSX } from 'solid-js';
import { cancelJob, openJob, pauseJob, resumeJob } from '../../lab/jobs';
import { operatorOnly } from '../../lab/operatorOnly';
import type { Addressed, Panels, Session } from '../../lab/slices';
import { isActive } from '../../lab/trainingStage';
import type { JobSummary } from '../../net/protocol.gen';
import { createAttempt } from '../../ui/attempt';
import { ConfirmButton } from '../../ui/ConfirmButton';
import { SmallButton } from '../../ui/SmallButton';
import { KIND_WORDS, nameOf, ownerWords, stageWords } from './words';

export function JobRow(props: {
  lab: Session & Addressed & Panels;
  job: JobSummary;
  /** Its view is shown. */
  onShow: () => void;
}): JSX.Element {
  const { attempt, refusal } = createAttempt();
  const [isCancelling, setCancelling] = createSignal(false);
  /** A comparison is that of its session, and only there. */
  const canShow = (): boolean =>
    props.job.has_results &&
    (props.job.kind !== 'comparison' || props.job.owner === props.lab.session);
  const show = (): void => {
    const { lab, job } = props;
    openJob(job);
    if (job.kind === 'evaluation') lab.address.show('evaluate');
    else if (job.kind === 'training') lab.address.show('train');
    else {
      lab.address.show('laboratory');
      lab.showPanel(job.kind === 'recovery' ? 'recovery' : 'compare');
    }
    props.onShow();
  };
  const isPaused = (): boolean => props.job.stage === 'paused';
  const cancel = async (): Promise<boolean> => {
    setCancelling(true);
    const isTaken = await attempt(cancelJob(props.job.id));
    setCancelling(isTaken);
    return isTaken;
  };
  const words = (): string =>
    isCancelling() && isActive(props.job) ? 'cancelling…' : stageWords(props.job);
  return (
    <li class="job" data-stage={props.job.stage} data-kind={props.job.kind}>
      <p class="job-name">
        <b>{KIND_WORDS[props.job.kind]}</b> <span>{props.job.name}</span>
      </p>
      <Show when={isActive(props.job)}>
        <progress
          max={1}
          value={props.job.share}
          data-stage={props.job.stage}
          aria-label={`Progress of ${nameOf(props.job)}`}
          aria-valuetext={words()}
        />
      </Show>
      <p class="job-words number">
        {words()} · {ownerWords(props.job, props.lab.session)}
      </p>
      <div class="job-deeds">
        <Show when={canShow()}>
          <SmallButton aria-label={`Show ${nameOf(props.job)}`} onClick={show}>
            Show
          </SmallButton>
        </Show>
        <Show when={props.job.can_pause || isPaused()}>
          <SmallButton
            {...operatorOnly(props.lab)}
            aria-label={`${isPaused() ? 'Resume' : 'Pause'} ${nameOf(props.job)}`}
            onClick={() =>
              void attempt(isPaused() ? resumeJob(props.job.id) : pauseJob(props.job.id))
            }
          >
            {isPaused() ? 'Resume' : 'Pause'}
          </SmallButton>
        </Show>
        <Show when={isActive(props.job) && !isCancelling()}>
          {/* What a training has learned is deleted. */}
          <Show
            when={props.job.kind === 'training'}
            fallback={
              <SmallButton
                {...operatorOnly(props.lab)}
                aria-label={`Cancel ${nameOf(props.job)}`}
                onClick={() => void cancel()}
              >
                Cancel
              </SmallButton>
            }
          >
            <ConfirmButton
              {...operatorOnly(props.lab)}
              verb="Cancel"
              of={nameOf(props.job)}
              onYes={cancel}
            />
          </Show>
        </Show>
      </div>
      <p class="refusal" role="alert">
        {refusal()}
      </p>
    </li>
  );
}

// The attempt, above the map: what to do, the clock, and how it ended.

import { Match, Show, Switch, createEffect, createMemo, type JSX } from 'solid-js';
import { VOIDS } from '../../words/facts';
import { CommandButton } from '../../lab/CommandButton';
import { isOver } from '../../lab/contest';
import type { ByHand, Contested, Panels, Session, Trial } from '../../lab/slices';
import type { AttemptStanding } from '../../net/protocol.gen';
import { seconds } from '../../ui/format';
import { isPhone } from '../../ui/windowSize';
import { penaltyWords, verdict } from './words';
import './stage.css';

type StageLab = Session & Trial & Contested & Panels & ByHand;

/** The tab may be open already, scrolled to another place. */
function showResult(): void {
  document.querySelector('.challenge-result')?.scrollIntoView({ block: 'nearest' });
}

export function StageBar(props: {
  lab: StageLab;
  /** Moves the focus to the map, for the arrow keys. */
  onStart?: () => void;
}): JSX.Element {
  const { lab } = props;
  const { contest } = lab;
  const waits = createMemo(
    () =>
      contest.name() !== undefined &&
      lab.state()?.tick === 0 &&
      lab.state()?.running === false &&
      lab.state()?.attempt?.void === null,
  );
  /** What an attempt is that cannot be gone on with. */
  const past = (attempt: AttemptStanding): string | undefined => {
    const state = lab.state();
    if (attempt.void) return `This attempt does not count: ${VOIDS[attempt.void.code]}.`;
    if (!state || !isOver(attempt)) return undefined;
    if (state.running) return 'The attempt is over. What happens now does not count.';
    return state.tick < state.newest_tick
      ? 'A moment of your attempt. The time line has the rest; what you do from here does not count.'
      : undefined;
  };
  const Again = (own: { isPrimary: boolean }): JSX.Element => (
    <CommandButton
      lab={lab}
      at="playback"
      class="small"
      classList={{ primary: own.isPrimary }}
      command={() => {
        const challenge = contest.name();
        return challenge === undefined ? undefined : { type: 'play_challenge', challenge };
      }}
    >
      Try again
    </CommandButton>
  );
  const start = (): void => {
    // The sheet may hide the goal.
    if (isPhone()) lab.closePanel();
    void lab.send('playback', { type: 'run' });
  };
  // The first movement of the hand starts the clock, too.
  const steers = createMemo(() => waits() && lab.steering.target() !== undefined);
  createEffect(() => {
    if (steers()) start();
  });
  return (
    <Show when={contest.attempt()}>
      {(attempt) => (
        <section class="contest" aria-label="Challenge">
          <Switch>
            <Match when={past(attempt())}>
              {(words) => (
                <>
                  <p role="status">{words()}</p>
                  <Again isPrimary={attempt().void !== null || lab.state()?.running === true} />
                </>
              )}
            </Match>
            <Match when={isOver(attempt())}>
              <p role="status">
                <strong class="number">
                  {attempt().is_delivered ? seconds(attempt().total_s) : ''}
                </strong>{' '}
                {verdict(attempt(), contest.report(), contest.ghosts())}
              </p>
              <Again isPrimary={false} />
              <button
                type="button"
                class="small primary"
                onClick={() => {
                  lab.showPanel('play');
                  requestAnimationFrame(showResult);
                }}
              >
                Result
              </button>
            </Match>
            <Match when={waits()}>
              <p>Roll the bead into the green ring. The clock starts when you steer.</p>
              <button
                type="button"
                class="small primary"
                disabled={!lab.canOperate()}
                onClick={() => {
                  start();
                  props.onStart?.();
                }}
              >
                Start
              </button>
            </Match>
            <Match when>
              <p class="contest-clock number" data-testid="contest-clock">
                {seconds(attempt().total_s)}
              </p>
              <p class="contest-penalties number">{penaltyWords(attempt(), contest.challenge())}</p>
              <p class="contest-fetching">
                {lab.state()?.phase.code === 'approaching' ? 'The arm fetches the bead.' : ''}
              </p>
            </Match>
          </Switch>
        </section>
      )}
    </Show>
  );
}

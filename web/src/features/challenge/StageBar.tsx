// The attempt, above the map: what to do, the clock, and how it ended.

import { Match, Show, Switch, createEffect, createMemo, type JSX } from 'solid-js';
import { VOIDS } from '../../words/facts';
import { CommandButton } from '../../lab/CommandButton';
import { isOver } from '../../lab/contest';
import type { ByHand, Contested, OpenTab, Session, Trial } from '../../lab/slices';
import { seconds } from '../../ui/format';
import { challengeTitle, penaltyWords, verdict } from './words';
import './stage.css';

type StageLab = Session & Trial & Contested & OpenTab & ByHand;

/** The tab may be open already, scrolled to another place. */
function showResult(): void {
  document.querySelector('.challenge-result')?.scrollIntoView({ block: 'nearest' });
}

function Again(props: { lab: StageLab; isPrimary: boolean }): JSX.Element {
  const { lab } = props;
  return (
    <CommandButton
      lab={lab}
      at="playback"
      class="small"
      classList={{ primary: props.isPrimary }}
      command={() => {
        const challenge = lab.contest.name();
        return challenge === undefined ? undefined : { type: 'play_challenge', challenge };
      }}
    >
      Try again
    </CommandButton>
  );
}

export function StageBar(props: {
  lab: StageLab;
  /** Moves the focus to the map, for the arrow keys. */
  onStart: () => void;
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
  const isRewound = (): boolean => {
    const state = lab.state();
    return state !== undefined && state.tick < state.newest_tick;
  };
  const start = (): void => {
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
            <Match when={attempt().void}>
              {(why) => (
                <>
                  <p role="status">This attempt does not count: {VOIDS[why().code]}.</p>
                  <Again lab={lab} isPrimary />
                </>
              )}
            </Match>
            <Match when={isOver(attempt()) && lab.state()?.running}>
              <p role="status">The attempt is over. What happens now does not count.</p>
              <Again lab={lab} isPrimary />
            </Match>
            <Match when={isOver(attempt()) && isRewound()}>
              <p role="status">
                This is a moment of your attempt. Drag the timeline below to see the rest; what you
                do from here does not count.
              </p>
              <Again lab={lab} isPrimary={false} />
            </Match>
            <Match when={isOver(attempt())}>
              <p role="status">
                <strong class="number">
                  {attempt().is_delivered ? seconds(attempt().total_s) : ''}
                </strong>{' '}
                {verdict(attempt(), contest.report(), contest.ghosts())}
              </p>
              <Again lab={lab} isPrimary={false} />
              <button
                type="button"
                class="small primary"
                onClick={() => {
                  lab.openTab('challenge');
                  requestAnimationFrame(showResult);
                }}
              >
                Result
              </button>
            </Match>
            <Match when={waits()}>
              <p>
                <strong>{challengeTitle(contest.name() ?? '')}</strong> Roll the bead into the green
                circle. The clock starts when you steer, or press Start.
              </p>
              <button
                type="button"
                class="small primary"
                disabled={!lab.canOperate()}
                onClick={() => {
                  start();
                  props.onStart();
                }}
              >
                Start
              </button>
            </Match>
            <Match when>
              <p class="contest-clock number" data-testid="contest-clock">
                {seconds(attempt().total_s)}
              </p>
              <p class="number">{penaltyWords(attempt(), contest.challenge())}</p>
              <Show when={lab.state()?.phase.code === 'approaching'}>
                <p>The arm fetches the bead.</p>
              </Show>
            </Match>
          </Switch>
        </section>
      )}
    </Show>
  );
}

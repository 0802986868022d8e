// The challenge that is being played: rules, ghosts, the result, and the board.

import { RotateCcw } from 'lucide';
import { For, Show, createMemo, type JSX } from 'solid-js';
import { CommandButton } from '../../lab/CommandButton';
import { boardPath, ghostName } from '../../lab/challenges';
import { isAtStake, isOver } from '../../lab/contest';
import { challengeCopy } from '../../lab/copyLink';
import { SIGHTS } from '../../lab/sight';
import type { ByHand, Contested, Session, Trial } from '../../lab/slices';
import type {
  AttemptStanding,
  BoardEntry,
  ChallengeReport,
  GhostMessage,
} from '../../net/protocol.gen';
import { Fact } from '../../ui/Fact';
import { seconds } from '../../ui/format';
import { Glyph } from '../../ui/Glyph';
import { Icon } from '../../ui/Icon';
import { OwnSession } from './OwnSession';
import { SignForm } from './SignForm';
import { DIFFICULTY_HELP, challengeTitle, lossWords, sumWords, verdict } from './words';
import { shownName } from '../../ui/name';
import { addressOf } from '../../net/base';

export type ChallengeLab = Session & Trial & Contested & ByHand;

/** Lines of the board. */
const LINES = 5;

function Rules(props: { rules: ChallengeReport }): JSX.Element {
  return (
    <section class="stack" aria-label="Rules">
      <h3>Rules</h3>
      <p class="hint">
        The score is the time until the bead rests in the goal circle. Each time that a wall stops
        the magnet adds {props.rules.wall_s} s. Each bead that the arm has to fetch again adds{' '}
        {props.rules.lost_bead_s} s, except after it was pulled away. Time is up after{' '}
        {props.rules.time_limit_s} s. An attempt counts if it runs in one go: no pause, no other
        speed, nothing but the magnet moved. What you see is your choice.
      </p>
    </section>
  );
}

/** The ghosts, and the attempt among them, best first. */
function Race(props: {
  ghosts: readonly GhostMessage[];
  attempt: AttemptStanding | undefined;
}): JSX.Element {
  const lines = createMemo(() => {
    const all = props.ghosts.map((ghost) => ({ ...ghost, name: ghostName(ghost), isOwn: false }));
    const { attempt } = props;
    const own = attempt && {
      name: 'This attempt',
      controller: 'you' as const,
      total_s: attempt.is_delivered ? attempt.total_s : null,
      isOwn: true,
    };
    return [...all, ...(own ? [own] : [])].sort(
      (a, b) => (a.total_s ?? Infinity) - (b.total_s ?? Infinity),
    );
  });
  return (
    <table class="table challenge-race">
      <caption class="visually-hidden">Scores on this challenge</caption>
      <tbody>
        <For each={lines()}>
          {(line) => (
            <tr classList={{ own: line.isOwn }}>
              <th scope="row">
                <Glyph of={line.controller} /> {line.name}
              </th>
              <td classList={{ late: line.total_s === null }}>
                {line.total_s === null ? 'not delivered' : seconds(line.total_s)}
              </td>
            </tr>
          )}
        </For>
      </tbody>
    </table>
  );
}

function Board(props: { board: readonly BoardEntry[] }): JSX.Element {
  return (
    <Show when={props.board.length > 0}>
      <section class="stack">
        <h3>Board</h3>
        <ol class="challenge-board plain">
          <For each={props.board.slice(0, LINES)}>
            {(line) => (
              <li>
                <span>
                  {shownName(line.player)}
                  {line.class === null ? '' : ` (${shownName(line.class)})`}
                </span>
                <span class="number">{seconds(line.total_s)}</span>
              </li>
            )}
          </For>
        </ol>
      </section>
    </Show>
  );
}

function Result(props: { lab: ChallengeLab; attempt: AttemptStanding }): JSX.Element {
  const { lab } = props;
  const { contest } = lab;
  const loss = (): string => {
    const [report, scene] = [contest.report(), lab.scene()];
    if (!report || !scene) return 'Comparing with the ghosts…';
    return report.loss
      ? lossWords(report.loss, report.compared_with, scene.tick_s)
      : 'No part of the way took much longer than needed.';
  };
  return (
    <section class="challenge-result" aria-label="Result">
      <p class="challenge-verdict">{verdict(props.attempt, contest.report(), contest.ghosts())}</p>
      <Show when={props.attempt.is_delivered && contest.challenge()}>
        {(rules) => <p class="number">{sumWords(props.attempt, rules())}</p>}
      </Show>
      <p>{loss()}</p>
      <Show when={contest.report()?.loss}>
        {(lost) => (
          <CommandButton
            lab={lab}
            at="playback"
            title="Rewinds the session to the beginning of this time. The attempt stays as it is."
            command={() => ({ type: 'rewind', tick: lost().from_tick })}
          >
            Show this moment
          </CommandButton>
        )}
      </Show>
      <Show when={props.attempt.is_delivered && contest.report()?.attempt}>
        <SignForm lab={lab} />
      </Show>
    </section>
  );
}

/** What the clock counts beside the time. */
function Attempt(props: { lab: ChallengeLab; attempt: AttemptStanding }): JSX.Element {
  const added = (count: number, each_s: number | undefined): JSX.Element => (
    <dd class="number">
      {count}
      <Show when={count > 0 && each_s}>{(s) => <span> +{count * s()} s</span>}</Show>
    </dd>
  );
  const rules = (): ChallengeReport | undefined => props.lab.contest.challenge();
  return (
    <section class="stack" aria-label="Your attempt">
      <h3>Your attempt</h3>
      <dl class="facts challenge-facts">
        <div>
          <dt>Wall stops</dt>
          {added(props.attempt.walls, rules()?.wall_s)}
        </div>
        <div>
          <dt>Lost beads</dt>
          {added(props.attempt.lost_beads, rules()?.lost_bead_s)}
        </div>
        <Fact
          name="You see"
          value={SIGHTS.find(([sight]) => sight === props.lab.sight())?.[1] ?? ''}
        />
      </dl>
    </section>
  );
}

export function PlayView(props: { lab: ChallengeLab; name: string }): JSX.Element {
  const { lab } = props;
  const { contest } = lab;
  const counts = createMemo(() => {
    const attempt = contest.attempt();
    return attempt?.void === null && isOver(attempt) ? attempt : undefined;
  });
  return (
    <>
      <section class="panel-intro">
        <h2>{challengeTitle(props.name)}</h2>
        <Show when={contest.challenge()}>
          {(rules) => (
            <p class="hint">
              Carry the bead to the green ring. A wall stop adds {rules().wall_s} s, a lost bead{' '}
              {rules().lost_bead_s} s. {DIFFICULTY_HELP[rules().difficulty]}
            </p>
          )}
        </Show>
      </section>
      <Show when={!lab.canOperate()}>
        <OwnSession challenge={props.name} />
      </Show>
      <Show when={contest.error()}>{(text) => <p class="refusal">{text()}</p>}</Show>
      <Show when={counts()}>{(attempt) => <Result lab={lab} attempt={attempt()} />}</Show>
      <section class="stack" aria-label="Ghosts">
        <h3>To beat</h3>
        <Show
          when={contest.ghosts()}
          fallback={
            <p class="hint">The controllers run this challenge now; their ghosts come soon.</p>
          }
        >
          {(all) => <Race ghosts={all().ghosts} attempt={counts()} />}
        </Show>
      </section>
      <Show when={contest.attempt()}>{(attempt) => <Attempt lab={lab} attempt={attempt()} />}</Show>
      <Show when={contest.challenge()}>
        {(rules) => (
          <>
            <Board board={rules().board} />
            <Rules rules={rules()} />
          </>
        )}
      </Show>
      <footer class="inspector-foot">
        <CommandButton
          lab={lab}
          at="playback"
          title="Ends the challenge and shows the others; the map stays"
          command={() => {
            const map = lab.scene()?.map;
            return map === undefined ? undefined : { type: 'load_scenario', map, controller: 'rl' };
          }}
        >
          {isAtStake(lab) ? 'Give up' : 'All challenges'}
        </CommandButton>
        <CommandButton
          lab={lab}
          at="playback"
          class="ghost icon-only"
          aria-label="From the start"
          title="Begins this challenge again"
          command={() => ({ type: 'play_challenge', challenge: props.name })}
        >
          <Icon of={RotateCcw} />
        </CommandButton>
        <a
          class="button ghost small"
          href={challengeCopy(props.name)}
          title="Opens this challenge in a session of the player’s own; send it to others"
        >
          Link
        </a>
        <a
          class="button ghost small"
          href={addressOf(boardPath(props.name))}
          target="_blank"
          rel="noopener"
        >
          Board
        </a>
      </footer>
    </>
  );
}

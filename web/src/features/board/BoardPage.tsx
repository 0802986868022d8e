// The page `/board`: the board of a challenge, large enough for a projector.

import { Show, createEffect, createMemo, createSignal, type JSX } from 'solid-js';
import { challengeCopy } from '../../lab/copyLink';
import { loggedOut } from '../../net/access';
import type { ChallengeReport, Challenges, ChallengeSummary } from '../../net/protocol.gen';
import { counted, fixed } from '../../ui/format';
import { listen } from '../../ui/listen';
import { BoardChoices } from './BoardChoices';
import { BoardTable } from './BoardTable';
import {
  type Chosen,
  type Row,
  boardAddress,
  chosenIn,
  classesOf,
  easyOfToday,
  longTitle,
  newWords,
  pageTitle,
  rowsOf,
} from './entries';
import { createBoard } from './live';
import { createPoll } from './poll';
import { shownName } from '../../ui/name';
import './board.css';

const LIST_MS = 15_000;

export default function BoardPage(): JSX.Element {
  const list = createPoll<Challenges>('/api/challenges', LIST_MS);
  const all = (): readonly ChallengeSummary[] => list.data()?.challenges ?? [];
  const [chosen, setChosen] = createSignal(chosenIn(window.location.search));
  const name = createMemo(() => chosen().challenge ?? easyOfToday(all()));
  const live = createMemo(() => {
    const now = name();
    return now === undefined ? undefined : createBoard(now);
  });
  const report = (): ChallengeReport | undefined => live()?.data();
  const summary = createMemo(() => all().find((one) => one.name === name()));
  const classes = createMemo(() => classesOf(report()?.board ?? [], chosen().ofClass));
  const rows = createMemo<readonly Row[]>((before) => {
    const now = report();
    return now ? rowsOf(now, chosen().ofClass, before) : [];
  }, []);
  const news = (): string => {
    const fresh = live()?.fresh();
    const added = fresh ? rows().filter(({ key }) => fresh.has(key)) : [];
    return added.map(newWords).join(' · ');
  };

  createEffect(() => {
    document.title = pageTitle(name(), chosen().ofClass);
  });
  const choose = (next: Chosen): void => {
    window.history.pushState(null, '', boardAddress(next));
    setChosen(next);
  };
  listen('popstate', () => setChosen(chosenIn(window.location.search)));

  return (
    <main class="board-page">
      <BoardChoices
        all={all()}
        name={name()}
        classes={classes()}
        chosen={chosen()}
        onChoose={choose}
      />
      <Head
        title={headWords(report() && name(), summary(), chosen().ofClass)}
        name={report() && name()}
        rules={rulesOf(rows().length, report())}
        news={news()}
      />
      {/* The region is always in the document: screen readers announce what appears inside it. */}
      <div class="board-problem" role="alert" aria-label="Problem">
        <Problem
          why={live()?.error() ?? list.error()}
          hasBoard={report() !== undefined}
          hasList={list.data() !== undefined}
        />
      </div>
      <Show when={report()}>
        {(now) => (
          <Show when={rows().length > 0} fallback={<Empty ofClass={chosen().ofClass} />}>
            <BoardTable name={now().name} rows={rows()} fresh={live()?.fresh() ?? new Set()} />
          </Show>
        )}
      </Show>
    </main>
  );
}

function headWords(
  name: string | undefined,
  summary: ChallengeSummary | undefined,
  ofClass: string | undefined,
): string {
  if (name === undefined) return 'Board';
  const title = longTitle(name, summary);
  return ofClass === undefined ? title : `${title}, class ${shownName(ofClass)}`;
}

function rulesOf(players: number, report: ChallengeReport | undefined): string {
  if (!report) return '';
  const penalty = (what: string, time_s: number): string =>
    `${what} +${fixed(time_s, Number.isInteger(time_s) ? 0 : 1)} s`;
  const penalties = [penalty('wall stop', report.wall_s), penalty('lost bead', report.lost_bead_s)];
  return [counted(players, 'player'), ...penalties].join(' · ');
}

/** The title, the address to play, and what is new. */
function Head(props: {
  title: string;
  /** Undefined before the board has come, and for a wrong name. */
  name: string | undefined;
  rules: string;
  news: string;
}): JSX.Element {
  return (
    <header class="board-head">
      <h1>{props.title}</h1>
      <p class="board-rules">{props.rules}</p>
      <p class="board-play">
        <Show when={props.name}>
          {(name) => (
            <>
              Play: <a href={challengeCopy(name())}>{challengeCopy(name())}</a>
            </>
          )}
        </Show>
      </p>
      <p class="board-news" role="status">
        {props.news}
      </p>
    </header>
  );
}

function Problem(props: {
  why: string | undefined;
  hasBoard: boolean;
  hasList: boolean;
}): JSX.Element {
  const advice = (): string =>
    props.hasBoard
      ? 'The board is the last one that the server has sent.'
      : props.hasList
        ? 'Choose a challenge above.'
        : '';
  return (
    <Show
      when={!loggedOut()}
      fallback={
        <p>
          The login has ended. <a href="">Log in again</a>
        </p>
      }
    >
      <Show when={props.why}>
        <p>{props.why}</p>
        <Show when={advice()}>{(words) => <p>{words()}</p>}</Show>
      </Show>
    </Show>
  );
}

function Empty(props: { ofClass: string | undefined }): JSX.Element {
  const ofClass = (before: string): string =>
    props.ofClass === undefined ? '' : `${before} ${shownName(props.ofClass)}`;
  return (
    <section class="board-empty">
      <h2>No attempt{ofClass(' of class')} is on this board yet</h2>
      <ol>
        <li>Open the address above in a browser.</li>
        <li>
          Steer the magnet and roll the bead to the goal. The ghosts of the controllers run beside
          you.
        </li>
        <li>Enter your name{ofClass(' and the class')}, and put your attempt on the board.</li>
      </ol>
    </section>
  );
}

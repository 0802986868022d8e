// The challenge that is being played: its ghosts, and after the attempt what is said about it.

import { createEffect, createMemo, createSignal, on } from 'solid-js';
import type {
  AttemptAnswer,
  AttemptQuery,
  AttemptReport,
  AttemptStanding,
  ChallengeReport,
  Ghosts,
} from '../net/protocol.gen';
import { get, post } from '../net/requests';
import { sessionPath } from '../net/session';
import type { Answer } from './commands';
import { challengePath } from './challenges';
import type { Session, Trial } from './slices';

export const isOver = (attempt: AttemptStanding | undefined): boolean =>
  attempt !== undefined && (attempt.is_delivered || attempt.is_time_up);

/** An attempt that runs and counts: a stray key must not end it. */
export const isAtStake = ({ state }: Pick<Trial, 'state'>): boolean => {
  const now = state();
  const attempt = now?.attempt ?? undefined;
  return attempt?.void === null && !isOver(attempt) && now?.running === true;
};

type Reads = Pick<Session, 'session' | 'send' | 'hello'> & Pick<Trial, 'scene' | 'state'>;

export function createContest(lab: Reads) {
  const name = createMemo(() => lab.scene()?.challenge ?? undefined);
  const attempt = createMemo(() => lab.state()?.attempt ?? undefined);
  const [challenge, setChallenge] = createSignal<ChallengeReport>();
  const [ghosts, setGhosts] = createSignal<Ghosts>();
  const [report, setReport] = createSignal<AttemptReport>();
  const [answer, setAnswer] = createSignal<AttemptAnswer>();
  const [error, setError] = createSignal<string>();

  /** Stores an answer if it is still about the same thing. */
  const load = async <A>(asking: Promise<A>, store: (data: A) => void, key: () => unknown) => {
    const asked = key();
    try {
      const data = await asking;
      if (key() === asked) store(data);
    } catch (reason) {
      if (key() === asked) setError(reason instanceof Error ? reason.message : String(reason));
    }
  };
  const loadBoard = async (of: string): Promise<void> => {
    await Promise.all([
      load(get<ChallengeReport>(challengePath(of)), setChallenge, name),
      load(get<Ghosts>(`${challengePath(of)}/ghosts`), setGhosts, name),
    ]);
  };
  createEffect(
    on(name, (now) => {
      setChallenge(undefined);
      setGhosts(undefined);
      setError(undefined);
      if (now !== undefined) void loadBoard(now);
    }),
  );
  const trial = createMemo(() => lab.scene()?.trial);
  const hasEnded = createMemo(() => isOver(attempt()));
  createEffect(
    on([trial, hasEnded], ([, over]) => {
      setReport(undefined);
      setAnswer(undefined);
      setError(undefined);
      if (!over) return;
      void load(get<AttemptReport>(sessionPath(lab.session, 'attempt')), setReport, trial);
    }),
  );
  return {
    /** Name of the challenge; undefined if none is being played. */
    name,
    attempt,
    /** Rules and board. */
    challenge,
    ghosts,
    /** About the attempt that has ended. */
    report,
    /** What the server said about the attempt that was sent. */
    answer,
    /** Why the newest request has no answer. */
    error,
    play: (challenge: string): Promise<Answer> =>
      lab.send('playback', { type: 'play_challenge', challenge }),
    /** Puts the attempt on the board. Throws a refusal. */
    sign: async (player: string, group: string): Promise<void> => {
      const [of, ended, seat] = [name(), report()?.attempt, lab.hello()?.seat];
      if (of === undefined || !ended || seat === undefined) return;
      const query: AttemptQuery = {
        session: lab.session,
        seat,
        player,
        attempt: ended,
        ...(group === '' ? {} : { class: group }),
      };
      const told = await post<AttemptAnswer>(
        `${challengePath(of)}/attempts`,
        JSON.stringify(query),
      );
      setAnswer(told);
      await loadBoard(of);
    },
  };
}

export type Contest = ReturnType<typeof createContest>;

// The challenges of the day and of the week, one with any seed, and those that were played before.

import { For, Show, createSignal, createUniqueId, type JSX } from 'solid-js';
import { DIFFICULTY_LABELS, PERIOD_LABELS } from '../../lab/challenges';
import type { Contested, Session } from '../../lab/slices';
import type { ChallengeSummary, DifficultyName, Period } from '../../net/protocol.gen';
import { counted, seconds } from '../../ui/format';
import { OwnSession } from './OwnSession';
import { challengeTitle, seedFault } from './words';
import { shownName } from '../../ui/name';
import { addressOf } from '../../net/base';

const ORDER: readonly Period[] = ['day', 'week'];

/** `Ada 14.2 s · 3 players`. */
function bestWords({ best, entries }: ChallengeSummary): string {
  return best
    ? `best: ${shownName(best.player)} ${seconds(best.total_s)} · ${counted(entries, 'player')}`
    : 'no player yet';
}

function Cards(props: {
  all: readonly ChallengeSummary[];
  title: (one: ChallengeSummary) => string;
  isDisabled: boolean;
  onPlay: (name: string) => void;
}): JSX.Element {
  return (
    <ol class="challenge-list">
      <For each={props.all}>
        {(one) => (
          <li>
            <button
              type="button"
              class="challenge-card"
              disabled={props.isDisabled}
              onClick={() => {
                props.onPlay(one.name);
              }}
            >
              <span class="challenge-title">{props.title(one)}</span>
              <span class="challenge-best number">{bestWords(one)}</span>
            </button>
          </li>
        )}
      </For>
    </ol>
  );
}

/** Any seed: who uses the same one gets the same trial. */
function OwnSeed(props: { isDisabled: boolean; onPlay: (name: string) => void }): JSX.Element {
  const id = createUniqueId();
  const [difficulty, setDifficulty] = createSignal<DifficultyName>('easy');
  const [seed, setSeed] = createSignal('');
  const [fault, setFault] = createSignal<string>();
  let field!: HTMLInputElement;
  return (
    <form
      class="challenge-own"
      onSubmit={(event) => {
        event.preventDefault();
        const wrong = seedFault(seed());
        setFault(wrong);
        if (wrong === undefined) props.onPlay(`${difficulty()}-${seed()}`);
        else field.focus();
      }}
    >
      <p id={`${id}-help`}>The same word gives the same trial, to everybody.</p>
      <label>
        Difficulty
        <select
          onChange={(event) => {
            setDifficulty(event.currentTarget.value as DifficultyName);
          }}
        >
          <For each={Object.entries(DIFFICULTY_LABELS)}>
            {([name, label]) => <option value={name}>{label}</option>}
          </For>
        </select>
      </label>
      <label>
        Word
        <input
          ref={field}
          type="text"
          autocomplete="off"
          autocapitalize="off"
          spellcheck={false}
          placeholder="anna-7b"
          aria-invalid={fault() !== undefined}
          aria-describedby={`${id}-help ${id}-fault`}
          onInput={(event) => {
            setSeed(event.currentTarget.value.trim().toLowerCase());
            setFault(undefined);
          }}
        />
      </label>
      <button type="submit" class="small" disabled={props.isDisabled}>
        Play this
      </button>
      <p id={`${id}-fault`} class="refusal" role="alert">
        {fault()}
      </p>
    </form>
  );
}

export function ChallengeList(props: { lab: Session & Contested }): JSX.Element {
  const { lab } = props;
  const of = (period: Period | null): readonly ChallengeSummary[] =>
    (lab.catalog.challenges() ?? []).filter((one) => one.period === period);
  const play = (name: string): void => {
    void lab.contest.play(name);
  };
  return (
    <>
      <p>
        Do the controllers’ work: steer the magnet and roll the bead to the goal, against the ghosts
        of RL, ERRT and Attractor. Each challenge takes less than a minute.
      </p>
      <Show when={!lab.canOperate()}>
        <OwnSession />
      </Show>
      <div class="challenge-columns">
        <For each={ORDER}>
          {(period) => (
            <section aria-label={PERIOD_LABELS[period]}>
              <h3>{PERIOD_LABELS[period]}</h3>
              <Cards
                all={of(period)}
                title={(one) => DIFFICULTY_LABELS[one.difficulty]}
                isDisabled={!lab.canOperate()}
                onPlay={play}
              />
            </section>
          )}
        </For>
        <section aria-label="Your own">
          <h3>Your own</h3>
          <OwnSeed isDisabled={!lab.canOperate()} onPlay={play} />
        </section>
        <Show when={of(null).length > 0}>
          <section aria-label="Earlier">
            <h3>Earlier</h3>
            <Cards
              all={of(null)}
              title={(one) => challengeTitle(one.name)}
              isDisabled={!lab.canOperate()}
              onPlay={play}
            />
          </section>
        </Show>
      </div>
      <p>
        <a class="button small" href={addressOf('/board')} target="_blank" rel="noopener">
          All boards
        </a>
      </p>
    </>
  );
}

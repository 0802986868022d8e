// The challenges of the day and of the week, one with any seed, and those that were played before.

import { For, Show, createSignal, type JSX } from 'solid-js';
import { DIFFICULTY_LABELS, PERIOD_LABELS } from '../../lab/challenges';
import type { Contested, Session } from '../../lab/slices';
import type { ChallengeSummary, DifficultyName, Period } from '../../net/protocol.gen';
import { ChoiceField, TextField } from '../../ui/fields/fields';
import { Form } from '../../ui/fields/Form';
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
  const [difficulty, setDifficulty] = createSignal<DifficultyName>('easy');
  const [seed, setSeed] = createSignal('');
  const word = (): string => seed().trim().toLowerCase();
  return (
    <Form
      class="challenge-fields"
      send={() => {
        props.onPlay(`${difficulty()}-${word()}`);
      }}
      button="Play this"
      buttonClass="small"
      disabled={props.isDisabled}
    >
      <ChoiceField
        label="Difficulty"
        value={difficulty()}
        options={Object.entries(DIFFICULTY_LABELS) as [DifficultyName, string][]}
        onChoose={setDifficulty}
      />
      <TextField
        label="Word"
        help="The same word gives the same trial, to everybody."
        placeholder="anna-7b"
        value={seed()}
        check={() => seedFault(word())}
        onInput={setSeed}
      />
    </Form>
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

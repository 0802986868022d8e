// The challenges of the day and of the week, one with any seed, and those that were played before.

import { ChevronRight, Trophy } from 'lucide';
import { For, Show, createSignal, type JSX } from 'solid-js';
import { DIFFICULTY_LABELS, PERIOD_LABELS } from '../../lab/challenges';
import type { Contested, Session } from '../../lab/slices';
import type { ChallengeSummary, DifficultyName, Period } from '../../net/protocol.gen';
import { ChoiceField, TextField } from '../../ui/fields/fields';
import { Form } from '../../ui/fields/Form';
import { Icon } from '../../ui/Icon';
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

function Shelf(props: {
  lab: Session & Contested;
  title: string;
  all: readonly ChallengeSummary[];
}): JSX.Element {
  return (
    <section class="stack" aria-label={props.title}>
      <h3>{props.title}</h3>
      <ol class="list">
        <For each={props.all}>
          {(one) => (
            <li>
              <button
                type="button"
                class="list-row"
                disabled={!props.lab.canOperate()}
                onClick={() => void props.lab.contest.play(one.name)}
              >
                <span>
                  <strong>
                    {one.period ? DIFFICULTY_LABELS[one.difficulty] : challengeTitle(one.name)}
                  </strong>
                  <small class="number">{bestWords(one)}</small>
                </span>
                <Icon of={ChevronRight} />
              </button>
            </li>
          )}
        </For>
      </ol>
    </section>
  );
}

/** Any seed: who uses the same one gets the same trial. */
function OwnSeed(props: { lab: Session & Contested }): JSX.Element {
  const [difficulty, setDifficulty] = createSignal<DifficultyName>('easy');
  const [seed, setSeed] = createSignal('');
  const word = (): string => seed().trim().toLowerCase();
  return (
    <Form
      class="challenge-fields"
      send={() => props.lab.contest.play(`${difficulty()}-${word()}`)}
      button="Play this"
      buttonClass=""
      disabled={!props.lab.canOperate()}
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
  return (
    <>
      <section class="panel-intro">
        <h2>Beat the controllers</h2>
        <p class="hint">
          Do their work: steer the magnet and roll the bead to the goal, against the ghosts of RL,
          ERRT and Attractor. Each challenge takes less than a minute.
        </p>
      </section>
      <Show when={!lab.canOperate()}>
        <OwnSession />
      </Show>
      <For each={ORDER}>
        {(period) => <Shelf lab={lab} title={PERIOD_LABELS[period]} all={of(period)} />}
      </For>
      <section class="stack" aria-label="Your own">
        <h3>Your own</h3>
        <OwnSeed lab={lab} />
      </section>
      <Show when={of(null).length > 0}>
        <Shelf lab={lab} title="Earlier" all={of(null)} />
      </Show>
      <footer class="inspector-foot">
        <a class="button" href={addressOf('/board')} target="_blank" rel="noopener">
          <Icon of={Trophy} />
          All boards
        </a>
      </footer>
    </>
  );
}

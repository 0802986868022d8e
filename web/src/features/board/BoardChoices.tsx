// The choice of a board: the challenges that are offered, earlier ones, and the classes.

import { For, Show, type JSX } from 'solid-js';
import type { ChallengeSummary } from '../../net/protocol.gen';
import { counted } from '../../ui/format';
import { type Chosen, boardAddress, shortTitle } from './entries';
import { shownName } from '../../ui/name';

export function BoardChoices(props: {
  all: readonly ChallengeSummary[];
  /** Name of the challenge that is shown. */
  name: string | undefined;
  classes: readonly string[];
  chosen: Chosen;
  onChoose: (chosen: Chosen) => void;
}): JSX.Element {
  return (
    <div class="board-choices">
      <Offered
        all={props.all.filter(({ period }) => period !== null)}
        now={props.name}
        ofClass={props.chosen.ofClass}
        onChoose={(chosen) => {
          props.onChoose(chosen);
        }}
      />
      <Earlier
        all={props.all.filter(({ period }) => period === null)}
        now={props.name}
        onChoose={(challenge) => {
          props.onChoose({ ...props.chosen, challenge });
        }}
      />
      <Show when={props.classes.length > 0}>
        <label class="board-choice">
          Class
          <select
            onChange={({ currentTarget: { value } }) => {
              props.onChoose({ ...props.chosen, ofClass: value === '' ? undefined : value });
            }}
          >
            <option value="" selected={props.chosen.ofClass === undefined}>
              all
            </option>
            <For each={props.classes}>
              {(one) => (
                <option value={one} selected={one === props.chosen.ofClass}>
                  {shownName(one)}
                </option>
              )}
            </For>
          </select>
        </label>
      </Show>
    </div>
  );
}

function Offered(props: {
  all: readonly ChallengeSummary[];
  now: string | undefined;
  ofClass: string | undefined;
  onChoose: (chosen: Chosen) => void;
}): JSX.Element {
  const follow = (event: MouseEvent, chosen: Chosen): void => {
    // A new tab or window opens the address.
    if (event.button !== 0 || event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    props.onChoose(chosen);
  };
  return (
    <nav class="board-offered" aria-label="Challenges">
      <For each={props.all}>
        {(one) => {
          const chosen = (): Chosen => ({ challenge: one.name, ofClass: props.ofClass });
          return (
            <a
              href={boardAddress(chosen())}
              title={one.name}
              aria-current={one.name === props.now ? 'page' : undefined}
              onClick={(event) => follow(event, chosen())}
            >
              {shortTitle(one)}
            </a>
          );
        }}
      </For>
    </nav>
  );
}

function Earlier(props: {
  all: readonly ChallengeSummary[];
  now: string | undefined;
  onChoose: (challenge: string) => void;
}): JSX.Element {
  const isEarlier = (): boolean => props.all.some(({ name }) => name === props.now);
  return (
    <Show when={props.all.length > 0}>
      <label class="board-choice">
        Earlier
        <select
          onChange={({ currentTarget: { value } }) => {
            if (value !== '') props.onChoose(value);
          }}
        >
          <option value="" selected={!isEarlier()}>
            –
          </option>
          <For each={props.all}>
            {({ name, entries }) => (
              <option value={name} selected={name === props.now}>
                {name} ({counted(entries, 'player')})
              </option>
            )}
          </For>
        </select>
      </label>
    </Show>
  );
}

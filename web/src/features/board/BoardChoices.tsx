// The choice of a board: the challenges that are offered, earlier ones, and the classes.

import { For, Show, type JSX } from 'solid-js';
import type { ChallengeSummary } from '../../net/protocol.gen';
import { counted } from '../../ui/format';
import { type Chosen, boardAddress, shortTitle } from './entries';
import { shownName } from '../../ui/name';

const ALL = '';

export function BoardChoices(props: {
  all: readonly ChallengeSummary[];
  /** Name of the challenge that is shown. */
  name: string | undefined;
  classes: readonly string[];
  chosen: Chosen;
  onChoose: (chosen: Chosen) => void;
}): JSX.Element {
  const earlier = (): readonly ChallengeSummary[] => props.all.filter(({ period }) => !period);
  return (
    <div class="board-choices">
      <nav class="board-offered" aria-label="Challenges">
        <For each={props.all.filter(({ period }) => period)}>
          {(one) => {
            const chosen = (): Chosen => ({ ...props.chosen, challenge: one.name });
            return (
              <a
                href={boardAddress(chosen())}
                title={one.name}
                aria-current={one.name === props.name ? 'page' : undefined}
                onClick={(event) => {
                  // A new tab or window opens the address.
                  if (event.button !== 0 || event.ctrlKey || event.metaKey || event.shiftKey)
                    return;
                  event.preventDefault();
                  props.onChoose(chosen());
                }}
              >
                {shortTitle(one)}
              </a>
            );
          }}
        </For>
      </nav>
      <Show when={earlier().length > 0}>
        <Choice
          label="Earlier"
          none="–"
          value={props.name}
          options={earlier().map(({ name, entries }) => [
            name,
            `${name} (${counted(entries, 'player')})`,
          ])}
          onChoose={(challenge) => {
            if (challenge !== ALL) props.onChoose({ ...props.chosen, challenge });
          }}
        />
      </Show>
      <Show when={props.classes.length > 0}>
        <Choice
          label="Class"
          none="all"
          value={props.chosen.ofClass}
          options={props.classes.map((one) => [one, shownName(one)])}
          onChoose={(one) =>
            props.onChoose({ ...props.chosen, ofClass: one === ALL ? undefined : one })
          }
        />
      </Show>
    </div>
  );
}

function Choice(props: {
  label: string;
  /** The first option, chosen if the value is not among the others. */
  none: string;
  value: string | undefined;
  options: readonly (readonly [value: string, text: string])[];
  onChoose: (value: string) => void;
}): JSX.Element {
  return (
    <label class="board-choice">
      {props.label}
      <select onChange={(event) => props.onChoose(event.currentTarget.value)}>
        <For each={[[ALL, props.none] as const, ...props.options]}>
          {([value, text]) => (
            <option value={value} selected={value === (props.value ?? ALL)}>
              {text}
            </option>
          )}
        </For>
      </select>
    </label>
  );
}

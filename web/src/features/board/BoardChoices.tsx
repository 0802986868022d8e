// The choice of a board: the challenges that are offered, earlier ones, and the classes.

import { For, Show, type JSX } from 'solid-js';
import type { ChallengeSummary } from '../../net/protocol.gen';
import { ChoiceField, type Option } from '../../ui/fields/fields';
import { counted } from '../../ui/format';
import { type Chosen, boardAddress, shortTitle } from './entries';
import { shownName } from '../../ui/name';

const NONE = '';
const earlierOption = ({ name, entries }: ChallengeSummary): Option => [
  name,
  `${name} (${counted(entries, 'player')})`,
];

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
        <ChoiceField<string>
          label="Earlier"
          value={props.name ?? NONE}
          options={[[NONE, '–'], ...earlier().map(earlierOption)]}
          onChoose={(challenge) => {
            if (challenge !== NONE) props.onChoose({ ...props.chosen, challenge });
          }}
        />
      </Show>
      <Show when={props.classes.length > 0}>
        <ChoiceField<string>
          label="Class"
          value={props.chosen.ofClass ?? NONE}
          options={[[NONE, 'all'], ...props.classes.map((one) => [one, shownName(one)] as const)]}
          onChoose={(one) =>
            props.onChoose({ ...props.chosen, ofClass: one === NONE ? undefined : one })
          }
        />
      </Show>
    </div>
  );
}
